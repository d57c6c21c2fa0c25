import numpy as np
import pytest
from colift.benchmark.rendering import labels
from colift.benchmark.rendering.labels import nearest

BOUNDS = (0.0, 0.0, 800.0, 500.0)


def place_labels(*args: object, **rest: object) -> np.ndarray:
    """Return the boxes of labels that all have a place."""
    boxes = labels.place_labels(*args, **rest)  # type: ignore[arg-type]
    assert all(box is not None for box in boxes)
    return np.reshape(np.array(boxes), (-1, 4))


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    sides = np.minimum(one[2:], other[2:]) - np.maximum(one[:2], other[:2])
    return float(np.prod(np.clip(sides, 0.0, None)))


def test_a_label_alone_stands_at_the_right_of_its_point() -> None:
    (box,) = place_labels([(400, 250)], [(60, 12)], bounds=BOUNDS)
    assert box[0] > 400
    assert box[1] < 250 < box[3]
    assert box[2] - box[0] == 60
    assert box[0] - 400 < 12


def test_at_the_edge_it_turns_to_the_other_side() -> None:
    (box,) = place_labels([(795, 250)], [(60, 12)], bounds=BOUNDS)
    assert box[2] < 795


def test_it_keeps_clear_of_an_obstacle() -> None:
    wall = (405.0, 200.0, 500.0, 300.0)
    (box,) = place_labels([(400, 250)], [(60, 12)], obstacles=[wall], bounds=BOUNDS)
    assert overlap(box, np.array(wall)) == 0.0


def test_its_line_does_not_run_through_another_point() -> None:
    """Near the point all is taken; at the right, where it would go, is the other point.

    The other's label is too wide for that place.
    """
    points = np.array([(400.0, 250.0), (440.0, 250.0)])
    taken = [(340.0, 190.0, 460.0, 310.0), (436.0, 246.0, 444.0, 254.0)]
    sizes, bounds = [(30, 12), (90, 12)], (0.0, 0.0, 520.0, 500.0)
    box, _ = place_labels(points, sizes, obstacles=taken, bounds=bounds)
    line = points[0] + np.linspace(0.0, 1.0, 200)[:, None] * (nearest(box, points[0]) - points[0])
    assert np.linalg.norm(line - points[1], axis=1).min() > 3.0


@pytest.mark.parametrize("seed", range(4))
def test_fourteen_labels_in_a_cluster_never_overlap_nor_leave_the_picture(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.normal((400.0, 250.0), 30.0, (14, 2))
    sizes = np.column_stack([rng.uniform(30.0, 150.0, 14), np.full(14, 13.0)])
    boxes = place_labels(points, sizes, bounds=BOUNDS)
    for i, box in enumerate(boxes):
        assert (box[:2] >= 0).all()
        assert (box[2:] <= BOUNDS[2:]).all()
        assert box[2:] - box[:2] == pytest.approx(sizes[i])
        assert all(overlap(box, other) == 0.0 for other in boxes[i + 1 :])


def test_labels_of_one_point_find_places_of_their_own() -> None:
    boxes = place_labels([(400, 250)] * 3, [(60, 12)] * 3, bounds=BOUNDS)
    assert overlap(boxes[0], boxes[1]) == overlap(boxes[0], boxes[2]) == 0.0
    assert overlap(boxes[1], boxes[2]) == 0.0


def test_the_same_points_give_the_same_places() -> None:
    points = np.random.default_rng(0).uniform(300.0, 400.0, (10, 2))
    sizes = [(80, 12)] * 10
    first = place_labels(points, sizes, bounds=BOUNDS)
    assert (place_labels(points, sizes, bounds=BOUNDS) == first).all()


def test_no_labels_are_no_boxes() -> None:
    assert place_labels([], [], bounds=BOUNDS).shape == (0, 4)


def test_it_covers_a_line_only_where_there_is_no_other_room() -> None:
    line = (420.0, 0.0, 422.0, 500.0)
    (box,) = place_labels([(400, 250)], [(60, 12)], lines=[line], bounds=BOUNDS)
    assert overlap(box, np.array(line)) == 0.0
    narrow = (390.0, 0.0, 470.0, 500.0)
    (box,) = place_labels([(400, 250)], [(60, 12)], lines=[line], bounds=narrow)
    assert overlap(box, np.array(line)) > 0.0


def test_a_label_without_a_free_place_has_none_and_the_first_come_first() -> None:
    points, sizes = [(50, 6), (50, 6)], [(60, 12), (60, 12)]
    first, second = labels.place_labels(points, sizes, bounds=(0.0, 0.0, 150.0, 13.0))
    assert first is not None
    assert second is None


def test_a_line_ends_at_the_near_side_of_its_label() -> None:
    box = np.array([10.0, 0.0, 20.0, 4.0])
    assert nearest(box, np.array([0.0, 2.0])).tolist() == [10.0, 2.0]
    assert nearest(box, np.array([30.0, 9.0])).tolist() == [20.0, 4.0]
