"""What every action on the material declares, and that a case needs nothing else to know it."""

import dataclasses
import inspect

import pytest

from mpmgeo.action import Action
from mpmgeo.case.kinds import declared
from mpmgeo.case.load import CaseError, load_case
from mpmgeo.case.spec import ACTIONS, Case
from mpmgeo.loads import LOADS

FIELDS = {item.key: item for item in declared(Case)}
HOOKS = ("particle_force", "fluid_force", "wets")

EACH = pytest.mark.parametrize("action", ACTIONS, ids=lambda action: action.key)


@EACH
def test_it_is_declared_in_full(action):
    assert issubclass(action, Action)
    assert dataclasses.is_dataclass(action)
    assert action.__dataclass_params__.frozen
    assert action.about[0].isupper() and not action.about.endswith(".")
    keys = {item.key for item in declared(action)}
    assert {action.switch} - {None} <= keys
    assert set(action.in_mesh) <= keys
    assert ("name" in keys) == (action.called is not None)
    assert not (action.needs_two_phases and action.one_phase_only)


@EACH
def test_the_case_has_its_field(action):
    item = FIELDS[action.key]
    assert item.field.metadata["doc"] == action.about
    assert item.field.default == (() if action.is_several else None)
    assert item.kind.is_container == action.is_several
    assert (item.kind.item if action.is_several else item.kind).classes == (action,)


def test_keys_are_unique():
    assert len({action.key for action in ACTIONS}) == len(ACTIONS)
    assert set(LOADS) < set(ACTIONS)


@pytest.mark.parametrize("hook", HOOKS)
def test_hooks_are_used_by_some_action(hook):
    assert any(hasattr(action, hook) for action in ACTIONS)
    assert f"`{hook}(" in inspect.getdoc(Action)


ALONE = [action for action in ACTIONS if action.one_phase_only]


@pytest.mark.parametrize("action", ALONE, ids=lambda action: action.key)
def test_what_it_does_not_go_with_is_refused_in_its_words(action):
    case = {"n_phases": 2, action.key: {action.switch: True}}
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert f"{action.key}: {action.one_phase_only}" in caught.value.problems
