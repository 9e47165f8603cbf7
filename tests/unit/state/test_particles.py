import numpy as np
from assembly import assemble


def test_arrays_are_those_of_the_scene():
    """What a scene does not use has no array to be sorted."""
    s = assemble(np.zeros((4, 3))).sets[0]
    assert [a.shape for a in s.arrays().values()] == [(4,), (4, 3), (4, 3), (4,), (4,), (4, 6)]
    s.half, s.force, s.state = np.ones((4, 3)), np.ones((4, 3)), np.ones((4, 2))
    assert len(s.arrays()) == 9


def test_one_heap_before_the_first_sort():
    s = assemble(np.zeros((4, 3))).sets[0]
    assert s.start.tolist() == [0, 4] and s.active == 4
