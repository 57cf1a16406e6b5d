//! Tests that a step allocates nothing: rocking through corners and impacts, at rest, overturning, with any
//! solver. Reading a record takes a small multiple of the file, whatever its header states.

#![allow(unsafe_code, reason = "a counting allocator")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use fmu_export::{Environment, Interface, Log, Model, ModelExchange, Step};
use ground_motion::{Format, RecordOptions, Unit as RecordUnit, parse_channels};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    DampingModel, ForceLaw, Impact, IntegerVariable, Mechanism, RealVariable, Solver,
};
use rocking_wall::wall::{Kinematics, Parameters, Support};

#[allow(dead_code, reason = "the tests of the readers use more of it")]
#[path = "../crates/ground-motion/tests/it/specimen.rs"]
mod specimen;

struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
    /// Bytes held by this thread, and the most since the peak was last reset.
    static HELD: Cell<usize> = const { Cell::new(0) };
    static PEAK: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: passes every call on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        HELD.with(|held| held.set(held.get().wrapping_add(layout.size())));
        PEAK.with(|peak| peak.set(peak.get().max(HELD.with(Cell::get))));
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.with(|held| held.set(held.get().wrapping_sub(layout.size())));
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Choices of a wall.
type Choices = [(IntegerVariable, i32)];

fn unit(choices: &Choices, interface: Interface) -> Unit {
    let environment = Environment { interface, instance_name: "wall", resources: None, payload: None };
    let mut unit = Unit::instantiate(environment, &mut Log::silent()).unwrap();
    for &(variable, value) in choices {
        unit.set_integer(variable, value);
    }
    unit.initialize(&mut Log::silent()).unwrap();
    unit
}

/// Full rotations move no FMU: the library steps by itself.
#[test]
fn a_step_in_full_rotations_allocates_nothing() {
    for mechanism in [Mechanism::Parapet, Mechanism::VerticalSpanning] {
        let parameters = Parameters {
            mechanism,
            kinematics: Kinematics::Trigonometric,
            force_law: ForceLaw::RigidLinear,
            damping_model: DampingModel::None,
            impact: Impact::Restitution,
            ..Parameters::default()
        };
        let mut simulation = Simulation::new(&parameters, None, 0.0, Support::default()).unwrap();
        let before = COUNT.with(Cell::get);
        for index in 0..4000_u32 {
            let support = |index: u32| Support::rigid(0.3 * (0.02 * f64::from(index)).sin());
            let segment = Segment { duration: 0.005, from: support(index), to: support(index + 1) };
            simulation.advance(&segment).unwrap();
        }
        assert_eq!(COUNT.with(Cell::get), before, "{mechanism:?}");
        assert!(simulation.progress().work.impacts > 2, "it rocked");
    }
}

/// Model Exchange with explicit steps of 1 ms, an event after each: through corners, impacts and rest.
#[test]
fn derivatives_and_events_allocate_nothing() {
    use IntegerVariable as V;
    let rigid = [
        (V::ForceLaw, ForceLaw::RigidLinear.value()),
        (V::DampingModel, DampingModel::None.value()),
        (V::Impact, Impact::Restitution.value()),
    ];
    let cases: [(&str, &Choices); 2] = [("constant ratio", &[]), ("rigid with restitution", &rigid)];
    for (name, choices) in cases {
        let mut unit = unit(choices, Interface::ModelExchange);
        let mut indicators = [0.0; Unit::EVENT_INDICATORS];
        let before = COUNT.with(Cell::get);
        unit.update(&mut Log::silent()).unwrap();
        let mut changes = 0;
        for index in 0..20_000_u32 {
            unit.set_time(0.001 * f64::from(index));
            let [u, v, a] =
                [RealVariable::U, RealVariable::UDot, RealVariable::UDdot].map(|name| unit.real(name));
            let v = v + 0.001 * a;
            unit.set_states(&[u + 0.001 * v, v]);
            unit.event_indicators(&mut indicators);
            unit.complete_step(&mut Log::silent()).unwrap();
            changes += u32::from(unit.update(&mut Log::silent()).unwrap().states_changed);
        }
        let allocations = COUNT.with(Cell::get) - before;
        assert!(unit.real(RealVariable::U).abs() < 0.1, "{name}: the wall has rocked");
        assert!(changes > 10, "{name}: {changes} changes of branch");
        assert_eq!(allocations, 0, "{name}: 20000 steps allocated {allocations} times");
    }
}

#[test]
fn a_step_allocates_nothing() {
    use IntegerVariable as V;
    let rigid = [
        (V::ForceLaw, ForceLaw::RigidLinear.value()),
        (V::DampingModel, DampingModel::None.value()),
        (V::Impact, Impact::Restitution.value()),
    ];
    let cases: [(&str, &Choices); 6] = [
        ("constant ratio", &[]),
        ("exact", &[(V::DampingModel, DampingModel::ConstantCoefficient.value())]),
        ("stiffness proportional", &[(V::DampingModel, DampingModel::StiffnessProportional.value())]),
        ("newmark", &[(V::Solver, Solver::Newmark.value())]),
        ("rigid with restitution", &rigid),
        ("vertical spanning", &[(V::Mechanism, Mechanism::VerticalSpanning.value())]),
    ];
    for (name, choices) in cases {
        let mut unit = unit(choices, Interface::CoSimulation);
        let before = COUNT.with(Cell::get);
        for index in 0..4000_u32 {
            let time = 0.005 * f64::from(index);
            for input in [RealVariable::ABottom, RealVariable::ATop] {
                unit.set_real(input, 3.0 * (9.0 * time).sin());
                unit.set_input_derivative(input, 27.0 * (9.0 * time).cos());
            }
            unit.set_real(RealVariable::Drift, 1e-3 * (2.0 * time).sin());
            unit.do_step(Step { from: time, duration: 0.005, may_end_early: false }, &mut Log::silent())
                .unwrap();
        }
        let allocations = COUNT.with(Cell::get) - before;
        assert!((unit.real(RealVariable::U) - 0.18).abs() > 1e-3, "{name}: the wall has moved");
        assert_eq!(allocations, 0, "{name}: 4000 steps allocated {allocations} times");
    }
}

/// The most bytes held while a text is read, beyond those held before; the text counts.
fn peak_of_reading(text: &[u8], format: Format) -> usize {
    let options = RecordOptions {
        format: Some(format),
        unit: Some(RecordUnit::CentimetrePerSecondSquared),
        step: Some(0.01),
        ..RecordOptions::default()
    };
    let before = HELD.with(Cell::get);
    PEAK.with(|peak| peak.set(before));
    let outcome = parse_channels("x", text.to_vec(), &options);
    let peak = PEAK.with(Cell::get) - before;
    drop(outcome);
    peak
}

/// Bytes held while a file is read, for each byte of it, and those for messages, headers and labels.
const MULTIPLE: usize = 16;
const BESIDE: usize = 1 << 16;

/// The densest samples take two bytes and become eight. A growing vector holds its old and its doubled new
/// memory, and the finished motion is a copy: 4 · 3 + 1 for the text. 64 kB are for messages and headers.
#[test]
fn reading_takes_a_small_multiple_of_the_file() {
    const SIZE: usize = 1 << 20;
    let row = |index: usize| format!("{index},1\n");
    let knet_row = |index: usize| format!(",{index},1\n");
    let at2 = |count: usize| format!("units of cm/s2\nNPTS= {count}, DT= .01 SEC\n");
    let knet = "Sampling Freq(Hz) 100Hz\nDuration Time(s)  9e15\nScale Factor      1(gal)/1\n";
    let knet = knet.to_owned() + &"Memo.\n".repeat(14);
    let csmip = "9999999999 points of accel data equally spaced at .01 sec, in cm/sec2. (100f2.0)\n";
    let cosmos = "100 Real-header values follow on 1 lines, Format= (100F2.0)\n".to_owned()
        + &"10".repeat(100)
        + "\n9999999999 acceleration pts, units=cm/sec2(04),Format=(1000F2.0)\n";
    let smc = "2 CORRECTED ACCELEROGRAM\n".to_owned()
        + &"*\n".repeat(10)
        + &(format!("{:10}", 2_147_483_647).repeat(8) + "\n").repeat(6)
        + &(format!("{:15}", 100).repeat(5) + "\n").repeat(10);
    let digits = "1".repeat(SIZE);
    let lines: String = digits.as_bytes().chunks(100).map(|_| "1".repeat(100) + "\n").collect();
    let esm = "SAMPLING_INTERVAL_S: 0.01\nNDATA: 9\nUNITS: cm/s^2\n".to_owned() + &"A:\n".repeat(61);
    let afad =
        "RECORDS OF TURKIYE\nNUMBER OF DATA : 9\nSAMPLING INTERVAL (sec) : .01\nPGA VALUES (gal) : 1\n";
    let names = |separator: &str| ["N", separator].concat().repeat(SIZE / 4);
    let unam = "ORIENTACION C1-C6 : /N/E\nNUM. TOTAL DE MUESTRAS, C1-C6 : /9/9\n\
                INTERVALO DE MUESTREO, C1-C6 (s) : /1/1\nUNIDADES DE LOS DATOS : Gal\n\
                FORMATO DATOS (FORTRAN,10 campos/dato) : 2F2.0\n---------+---------+\n---------+---------+\n";
    let volume_1 = "* VOL1DS FILE: 1\nNO. OF POINTS = 999999999 DURATION = 9\nUNITS ARE SECONDS AND G/10\n";
    let knet_csv = "#SamplingFrequency(Hz)\n#1\n#DurationTime(s)\n#9\n#Time,RelativeTime(s),N-S(gal)\n";
    let geonet = "Uncorrected accelerogram GNS Science\n".to_owned()
        + &format!("{:8}", 99_999_999).repeat(40)
        + &"1".repeat(480);
    let cwa = "#SampleRate(Hz): 1\n#AmplitudeUnit: gal\n#DataSequence: Time N\n#Data: 2F2.0\n";
    let fdsn = "TIMESERIES X, 9 samples, 100 sps, 2016, SLIST, FLOAT, M/S**2\n".to_owned();
    let texts: [(Format, String); 24] = [
        (Format::At2, at2(SIZE / 2) + &"1 ".repeat(SIZE / 2)),
        (Format::At2, at2(usize::MAX) + "1 1 1\n"),
        (Format::Csv, "1\n".repeat(SIZE / 2)),
        (Format::Csv, "time,a\n".to_owned() + &(0..SIZE / 8).map(row).collect::<String>()),
        (Format::Knet, knet + &"1 ".repeat(SIZE / 2)),
        (Format::Csmip, csmip.to_owned() + &lines),
        (Format::Cosmos, cosmos + &digits),
        (Format::Smc, smc + &"|\n".repeat(SIZE / 2)),
        (Format::Esm, esm + &"1\n".repeat(SIZE / 2)),
        (Format::Afad, afad.to_owned() + "N E\n" + &"1 1\n".repeat(SIZE / 4)),
        (Format::Afad, afad.to_owned() + &names(" ") + "\n1 1\n"),
        (Format::Unam, unam.to_owned() + &" 1 1\n".repeat(SIZE / 5)),
        (Format::Unam, unam.replace("/N/E", &names("/"))),
        (Format::Unam, "A : 1\n".repeat(SIZE / 6)),
        (Format::Volume1, volume_1.to_owned() + &"1 ".repeat(SIZE / 2)),
        (Format::Volume1, volume_1.to_owned() + &"1. 1.\n".repeat(SIZE / 6)),
        (Format::KnetCsv, knet_csv.to_owned() + &(0..SIZE / 8).map(knet_row).collect::<String>()),
        (Format::KnetCsv, knet_csv.replace("N-S(gal)", &names(","))),
        (Format::Geonet, geonet + &"       1".repeat(SIZE / 8)),
        (Format::Cwa, cwa.to_owned() + &" 1 1\n".repeat(SIZE / 5)),
        (Format::Cwa, "#\n".repeat(SIZE / 2)),
        (Format::Fdsn, fdsn + &"1 ".repeat(SIZE / 2)),
        (Format::Fdsn, "#\n".repeat(SIZE / 2)),
        (Format::Numbers, "1 ".repeat(SIZE / 2)),
    ];
    for (format, text) in texts {
        let peak = peak_of_reading(text.as_bytes(), format);
        assert!(peak <= MULTIPLE * text.len() + BESIDE, "{format:?}: {peak} bytes for {}", text.len());
    }
    for format in Format::ALL {
        for byte in [b' ', b'\n', b'1', b'*', b'|', b':', 0xff] {
            let peak = peak_of_reading(&vec![byte; SIZE], format);
            assert!(peak <= MULTIPLE * SIZE, "{format:?}: {peak} bytes for {SIZE} times 0x{byte:02x}");
        }
    }
}

proptest! {
    #![proptest_config(
        ProptestConfig { cases: 100, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
    )]

    /// Damaged files: header numbers that ask for more than the file has, joined lines, endless blanks.
    #[test]
    fn damaged_files_take_a_small_multiple_too(
        edits in specimen::edits(),
        digits in any::<prop::sample::Index>(),
        blanks in 0..20_000_usize,
        blank in prop::sample::select(vec![" ", "\n", "\r\r\n", "*", ".", "NaN ", "1E9"]),
        bytes in prop::collection::vec(any::<u8>(), 0..4000),
    ) {
        for (format, write) in specimen::ALL {
            let text = write(&specimen::SAMPLES);
            let damaged = specimen::mutated(&text, &edits);
            // a run of digits becomes the largest number, and blanks or stars follow it
            let place = digits.index(text.len());
            let start = text[place..].find(|c: char| c.is_ascii_digit()).map_or(text.len(), |at| place + at);
            let rest = text[start..].trim_start_matches(|c: char| c.is_ascii_digit());
            let swollen = format!("{}99999999999{}{rest}", &text[..start], blank.repeat(blanks));
            for bytes in [damaged, swollen.into_bytes(), bytes.clone()] {
                let peak = peak_of_reading(&bytes, format);
                let length = bytes.len();
                prop_assert!(peak <= MULTIPLE * length + BESIDE, "{format:?}: {peak} bytes for {length}");
            }
        }
    }
}
