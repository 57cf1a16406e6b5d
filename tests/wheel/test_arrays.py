"""Samples are copied, whatever array they come in, or refused; never misread."""

import numpy as np
import pytest

import rocking_wall as rw

SAMPLES = np.array([0.0, 0.5, -1.25, 3.0, -0.75, 0.25])


def misaligned(values):
    """Returns the values at an address that is not a multiple of eight."""
    place = np.zeros(8 * len(values) + 1, dtype=np.uint8)[1:].view(np.float64)
    place[:] = values
    assert not place.flags.aligned
    return place


@pytest.mark.parametrize(
    "given",
    [
        SAMPLES,
        list(SAMPLES),
        tuple(SAMPLES),
        np.repeat(SAMPLES, 3)[::3],
        SAMPLES[::-1][::-1],
        np.column_stack([SAMPLES, SAMPLES + 1.0])[:, 0],
        np.asfortranarray(np.column_stack([SAMPLES, SAMPLES + 1.0]))[:, 0],
        SAMPLES.astype(np.float32),
        SAMPLES.astype(np.float16),
        SAMPLES.astype(np.longdouble),
        SAMPLES.astype(">f8"),
        SAMPLES.astype("<f8"),
        misaligned(SAMPLES),
        misaligned(np.repeat(SAMPLES, 2))[::2],
        np.ma.masked_array(SAMPLES),
    ],
)
def test_samples_are_copied(given):
    record = rw.Record(0.01, given)
    np.testing.assert_array_equal(record.a, SAMPLES)
    assert record.a.dtype == np.float64 and record.a.flags.aligned and not record.a.flags.writeable


@pytest.mark.parametrize("kind", [np.int8, np.int32, np.uint16, np.int64])
def test_whole_numbers_are_numbers(kind):
    np.testing.assert_array_equal(rw.Record(0.01, np.array([1, 2, 3], dtype=kind)).a, [1.0, 2.0, 3.0])


def test_a_record_does_not_change_with_its_source():
    source = SAMPLES.copy()
    record = rw.Record(0.01, source)
    source[:] = 7.0
    np.testing.assert_array_equal(record.a, SAMPLES)


def test_series_of_pandas():
    pandas = pytest.importorskip("pandas")
    np.testing.assert_array_equal(rw.Record(0.01, pandas.Series(SAMPLES)[::2]).a, SAMPLES[::2])


def test_columns_of_pyarrow():
    pandas, pyarrow = pytest.importorskip("pandas"), pytest.importorskip("pyarrow")
    columns = (
        pyarrow.array(SAMPLES),
        pyarrow.chunked_array([SAMPLES[:2], SAMPLES[2:]]),
        pandas.Series(SAMPLES, dtype="double[pyarrow]"),
    )
    for column in columns:
        np.testing.assert_array_equal(rw.Record(0.01, column).a, SAMPLES)


@pytest.mark.parametrize(
    "given, error, words",
    [
        (SAMPLES + 0j, TypeError, "complex128"),
        (np.array(["a", "b"]), TypeError, "<U1"),
        (SAMPLES > 0, TypeError, "bool"),
        (np.array([1, None]), TypeError, "object"),
        (np.array([1, 2], dtype="m8[s]"), TypeError, "timedelta64"),
        (np.zeros((3, 2)), ValueError, r"one dimension, found the shape \(3, 2\)"),
        (1.0, ValueError, r"one dimension, found the shape \(\)"),
        (np.ma.masked_less(SAMPLES, 0.0), ValueError, "masked"),
        ([0.0, np.nan], ValueError, "sample 1 .* is NaN; every sample must be finite"),
        ([1.0], ValueError, "at least two samples, found 1"),
    ],
)
def test_other_values_are_refused(given, error, words):
    with pytest.raises(error, match=words):
        rw.Record(0.01, given)


def test_a_step_must_be_positive():
    with pytest.raises(ValueError, match="time step .* must be positive and finite, found 0 s"):
        rw.Record(0.0, SAMPLES)


def test_factors_and_periods_are_arrays_too(record):
    wall = rw.Wall(height=3, thickness=0.25)
    factors = np.array([0.5, 9.0, 1.0, 9.0])[::2]
    np.testing.assert_array_equal(wall.peaks(record, factors).u_max, wall.peaks(record, [0.5, 1.0]).u_max)
    periods = misaligned([0.0, 0.5])
    np.testing.assert_array_equal(record.spectrum(periods), record.spectrum([0.0, 0.5]))
