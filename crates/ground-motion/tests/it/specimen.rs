//! Small records of the project's own in every format and in every form of a text table, with samples in
//! cm/s² and a step of 0.01 s.

#[path = "specimen_fdsn.rs"]
pub(crate) mod fdsn;

use std::fmt::Write;

use ground_motion::{Format, RecordOptions, Unit};
use proptest::prelude::*;

/// Samples that every format holds to the digit, without a mean; an odd number, for a short last line.
pub(crate) const SAMPLES: [f64; 11] =
    [0.125, -1.5, 22.75, -103.25, 87.5, -0.001, 44.25, -60.5, 12.0, -1.25, -0.124];

pub(crate) const STEP: f64 = 0.01;

/// What a writer makes of samples.
pub(crate) type Writer = fn(&[f64]) -> String;

/// Every format with its writers.
pub(crate) const ALL: [(Format, Writer); 23] = [
    (Format::At2, at2),
    (Format::Esm, esm),
    (Format::Knet, knet),
    (Format::Cosmos, cosmos),
    (Format::Csmip, csmip),
    (Format::Smc, smc),
    (Format::Csv, csv),
    (Format::Csv, pairs),
    (Format::Csv, tabs),
    (Format::Csv, semicolons),
    (Format::Csv, with_units),
    (Format::Esm, itaca),
    (Format::Geonet, geonet_raw),
    (Format::Geonet, geonet),
    (Format::Afad, afad),
    (Format::Cwa, cwa),
    (Format::Unam, unam),
    (Format::Volume1, renadic),
    (Format::Volume1, bhrc),
    (Format::KnetCsv, knet_csv),
    (Format::Fdsn, fdsn::slist),
    (Format::Fdsn, fdsn::tspair),
    (Format::Fdsn, fdsn::geocsv),
];

/// What has to be stated to read a format.
pub(crate) fn options(format: Format) -> RecordOptions {
    let unit = (format == Format::Csv).then_some(Unit::CentimetrePerSecondSquared);
    RecordOptions { unit, ..RecordOptions::default() }
}

/// The unit in which the specimens of a format are written.
pub(crate) fn unit(format: Format) -> Unit {
    match format {
        Format::Geonet => Unit::MillimetrePerSecondSquared,
        Format::Volume1 => Unit::StandardGravity,
        _ => Unit::CentimetrePerSecondSquared,
    }
}

/// Numbers in fixed columns, so many a line.
fn columns(values: &[f64], per_line: usize, number: impl Fn(f64) -> String) -> String {
    let line = |values: &[f64]| values.iter().map(|&value| number(value)).collect::<String>() + "\n";
    values.chunks(per_line).map(line).collect()
}

/// The sample of the largest size.
fn peak(samples: &[f64]) -> f64 {
    samples.iter().copied().fold(0.0, |peak: f64, a| if a.abs() > peak.abs() { a } else { peak })
}

pub(crate) fn at2(samples: &[f64]) -> String {
    format!(
        "PEER DATABASE, A TEST\nNowhere, 1/1/2001, Test hill, 90\n\
         ACCELERATION TIME SERIES IN UNITS OF CM/S2\n\
         NPTS=  {:5}, DT=   .0100 SEC,\n{}",
        samples.len(),
        columns(samples, 5, |a| format!("{a:15.6E}"))
    )
}

pub(crate) fn esm(samples: &[f64]) -> String {
    let mut text = String::new();
    let stated = [
        ("EVENT_NAME", "A TEST".to_owned()),
        ("EVENT_DATE_YYYYMMDD", "20010101".to_owned()),
        ("STATION_NAME", "Test hill: the top".to_owned()),
        ("VS30_M/S", String::new()),
        ("SAMPLING_INTERVAL_S", "0.010000".to_owned()),
        ("NDATA", samples.len().to_string()),
        ("STREAM", "HNE".to_owned()),
        ("UNITS", "cm/s^2".to_owned()),
        ("PGA_CM/S^2", format!("{:.6}", peak(samples))),
        ("DATA_TYPE", "ACCELERATION".to_owned()),
    ];
    for (key, value) in &stated {
        let _ = writeln!(text, "{key}: {value}");
    }
    for index in stated.len()..64 {
        let _ = writeln!(text, "USER{index}: ");
    }
    text + &columns(samples, 1, |a| format!("{a:.6}"))
}

/// Counts of 0.001 cm/s² about an offset of −12 000.
pub(crate) fn knet(samples: &[f64]) -> String {
    let labels = [
        ("Origin Time", "2001/01/01 00:00:00".to_owned()),
        ("Lat.", "1.0".to_owned()),
        ("Long.", "2.0".to_owned()),
        ("Depth. (km)", "10".to_owned()),
        ("Mag.", "5.0".to_owned()),
        ("Station Code", "TST001".to_owned()),
        ("Station Lat.", "1.1".to_owned()),
        ("Station Long.", "2.1".to_owned()),
        ("Station Height(m)", "7".to_owned()),
        ("Record Time", "2001/01/01 00:00:15".to_owned()),
        ("Sampling Freq(Hz)", "100Hz".to_owned()),
        ("Duration Time(s)", (samples.len() as f64 / 100.0).to_string()),
        ("Dir.", "E-W".to_owned()),
        ("Scale Factor", "2000(gal)/2000000".to_owned()),
        ("Max. Acc. (gal)", format!("{:.3}", peak(samples).abs())),
        ("Last Correction", "2001/01/01 00:00:15".to_owned()),
        ("Memo.", String::new()),
    ];
    let header: Vec<_> = labels.iter().map(|(label, value)| format!("{label:<18}{value}\n")).collect();
    header.concat() + &columns(samples, 8, |a| format!("{:8.0} ", (1000.0 * a).round() - 12_000.0))
}

pub(crate) fn cosmos(samples: &[f64]) -> String {
    let mut reals = [-999.0; 100];
    reals[61] = 10.0;
    reals[63] = peak(samples);
    format!(
        "Corrected acceleration    (Format v01.20 with 3 text lines)\nA test on a hill\n\
         Sta Chan   2: 90 Deg (Rcrdr Chan  2) Location: the top\n \
         100 Integer-header values follow on  10 lines, Format= (10I8)\n{} \
         100 Real-header values follow on  20 lines, Format= (5F15.6)\n{}   \
         1 Comment line(s) follow, each starting with a \"|\":\n| 7 pts, Format=(1F2) is but a comment\n{:8} \
         acceleration pts, approx {:4.0} secs, units=cm/sec2(04),Format=(8F10.3)\n{}\
         End-of-data for Chan 2 acceleration\n",
        columns(&[-999.0; 100], 10, |value| format!("{value:8.0}")),
        columns(&reals, 5, |value| format!("{value:15.6}")),
        samples.len(),
        samples.len() as f64 * STEP,
        columns(samples, 8, |a| format!("{a:10.3}"))
    )
}

pub(crate) fn csmip(samples: &[f64]) -> String {
    csmip_channels(&[(1, " 90 Deg", samples)])
}

pub(crate) fn csmip_channels(channels: &[(u32, &str, &[f64])]) -> String {
    let mut text = String::new();
    for &(number, direction, samples) in channels {
        let count = samples.len();
        let block = |quantity: &str, unit: &str| {
            let data = columns(samples, 8, |a| format!("{a:10.3}"));
            format!(
                "{count:6} points of {quantity} data equally spaced at  .010 sec, in {unit}. (8f10.3)\n{data}"
            )
        };
        let _ = write!(
            text,
            "Corrected accelerogram   A test\nUncorrected Accelerogram Data\n\nChan {number:2}:{direction}\n\
             {count:6} points of instrument- and baseline-corrected accel, veloc and displ data\n\
             At equally-spaced intervals of .010 sec.\n\
             Peak acceleration = {:9.3}    cm/sec/sec  at    0.030   sec.\n{}{}{}{}{}\
             /&  ----------  End of data for channel {number:2}  ----------\n",
            peak(samples),
            columns(&[0.0; 100], 16, |value| format!("{value:5.0}")),
            columns(&[0.0; 100], 8, |value| format!("{value:10.3}")),
            block("accel", "cm/sec2"),
            block("veloc", "cm/sec"),
            block("displ", "cm"),
        );
    }
    text
}

pub(crate) fn smc(samples: &[f64]) -> String {
    let mut integers = [-32_768.0; 48];
    integers[15] = 2.0;
    integers[16] = samples.len() as f64;
    let mut reals = [1.7e38; 50];
    reals[1] = 100.0;
    reals[29] = samples.iter().copied().fold(0.0, f64::max);
    reals[31] = samples.iter().copied().fold(0.0, f64::min);
    format!(
        "2 CORRECTED ACCELEROGRAM\n{}{}{}|\n|a test\n{}",
        "*\n".repeat(10),
        columns(&integers, 8, |value| format!("{value:10.0}")),
        columns(&reals, 5, |value| format!("{value:15.7E}")),
        columns(samples, 8, |a| format!("{a:10.4E}"))
    )
}

pub(crate) fn csv(samples: &[f64]) -> String {
    "time,a_g\n".to_owned() + &rows(samples, |time, a| format!("{time:.3},{a}"))
}

/// Times and accelerations between blanks, below a comment with the words of AT2.
pub(crate) fn pairs(samples: &[f64]) -> String {
    format!("# Test hill, NPTS = {}, DT = 0.01 s\n", samples.len())
        + &rows(samples, |time, a| format!("{time:8.3} {a}"))
}

/// A table between tabs, below a title with the words of AT2.
pub(crate) fn tabs(samples: &[f64]) -> String {
    let title = format!("Test hill: npts {} and dt 0.01 s\n", samples.len());
    title + "Time [sec]\tAcceleration\n" + &rows(samples, |time, a| format!("{time:.2}\t{a}"))
}

/// A table between semicolons, with decimal commas.
pub(crate) fn semicolons(samples: &[f64]) -> String {
    "time;a_g\n".to_owned() + &rows(samples, |time, a| format!("{time:.3};{a}").replace('.', ","))
}

/// A table whose header line states the units.
pub(crate) fn with_units(samples: &[f64]) -> String {
    "t [s],a [cm/s2]\n".to_owned() + &rows(samples, |time, a| format!("{time:.3},{a}"))
}

/// ITACA before DYNA 1.0, below a title: 43 lines, and a component in place of a stream.
pub(crate) fn itaca(samples: &[f64]) -> String {
    let text = esm(samples).replace("STREAM: HNE", "COMPONENT: WE");
    let text = text.replace("DATA_TYPE: ACC", "DATA_TYPE: UNPROCESSED ACC");
    let (filler, whole) = ("USER", text.lines());
    let kept = whole.filter(|line| !line.starts_with(filler) || line[filler.len()..] < *"43");
    "A title of its own\n".to_owned() + &kept.map(|line| line.to_owned() + "\n").collect::<String>()
}

/// A component in mm/s², with as many velocities and displacements if it is corrected.
fn geonet_component(samples: &[f64], is_raw: bool) -> String {
    let count = samples.len() as f64;
    let (mut integers, mut reals) = ([0.0; 40], [0.0; 60]);
    reals[25] = STEP;
    let rows = |unit: f64| columns(samples, 10, |a| format!("{:8.2}", a * unit));
    let (title, blocks) = if is_raw {
        (integers[30], reals[30]) = (count, 10.0 * peak(samples));
        ("Unc", rows(10.0))
    } else {
        for place in [33, 34, 35] {
            integers[place] = count;
        }
        reals[35] = 10.0 * peak(samples);
        ("C", rows(10.0) + &rows(0.1) + &rows(0.01))
    };
    format!(
        "{title}orrected accelerogram A_TEST_20 GNS Science\nA test on a hill\n\n\
         Component N10E  An axis\n{}{}{}",
        columns(&integers, 10, |value| format!("{value:8.0}")),
        columns(&reals, 10, |value| format!("{value:8.2}")),
        blocks
    )
}

pub(crate) fn geonet(samples: &[f64]) -> String {
    geonet_component(samples, false)
}

pub(crate) fn geonet_raw(samples: &[f64]) -> String {
    geonet_component(samples, true)
}

pub(crate) fn afad(samples: &[f64]) -> String {
    format!(
        "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                   : A TEST\n\
         NUMBER OF DATA          : {}\nSAMPLING INTERVAL (sec) : 0.01\n\
         RAW PGA VALUES (gal)    : (N-S) {:.3}\nCopyright NOBODY\n       N-S\n{}",
        samples.len(),
        peak(samples).abs(),
        columns(samples, 1, |a| format!("{a:15.6}"))
    )
}

pub(crate) fn cwa(samples: &[f64]) -> String {
    let largest = samples.iter().copied().fold(0.0, f64::max);
    let smallest = samples.iter().copied().fold(0.0, f64::min);
    format!(
        "#StationCode: TST\n#RecordLength(sec):  {:.3}\n#SampleRate(Hz): 100\n\
         #AmplitudeUnit:  gal. DCoffset(corr)\n#AmplitudeMAX. N:    {largest:.3}~   {smallest:.3}\n\
         #DataSequence: Time N(+)\n#Data: 2F10.3\n{}",
        samples.len() as f64 * STEP,
        rows(samples, |time, a| format!("{time:10.3}{a:10.3}"))
    )
}

pub(crate) fn unam(samples: &[f64]) -> String {
    format!(
        "*****\n  INSTITUTO DE INGENIERIA, UNAM\nARCHIVO ESTANDAR DE ACELERACION:\n\
         NOMBRE DE LA ESTACION                  : A TEST: THE HILL\n\
         ORIENTACION C1-C6 (rumbo;orientacion)  : /N00E\n\
         ORIENTACION C7-C12 (rumbo;orientacion) : \n\
         INTERVALO DE MUESTREO, C1-C6 (s)       : /0.01\n\
         NUM. TOTAL DE MUESTRAS, C1-C6          : /{}\n\
         ACEL. MAX.(Gal), C1-C6                 : /{:.2}\n\
         ACEL. MAX., C1-C6, EN LA MUESTRA       : /4\n\
         UNIDADES DE LOS DATOS                  : Gal (cm/s/s)\n\
         FORMATO DATOS (FORTRAN,10 campos/dato) : 1F10.4\n\n\
         DATOS DE ACELERACION:\n{RULER}   CANAL-1\n      N00E\n{RULER}{}",
        samples.len(),
        peak(samples),
        columns(samples, 1, |a| format!("{a:10.4}"))
    )
}

const RULER: &str = "---------+---------+---------+\n";

/// 100 integers, 50 reals and what follows them, up to the closing line; `digits` of a number in g/10.
fn volume_1(text: &str, numbers: &[f64], digits: impl Fn(f64) -> String) -> String {
    format!(
        "{text}{}{}{}/&  ----------  END OF DATA FOR CHANNEL 1  ----------\n",
        columns(&[0.0; 100], 16, |value| format!("{value:5.0}")),
        columns(&[0.0; 50], 8, |value| format!("{value:10.3}")),
        columns(numbers, 10, digits)
    )
}

/// The scale of cm/s² in g/10.
const TENTHS: f64 = 98.0665;

/// Times and accelerations in pairs.
pub(crate) fn renadic(samples: &[f64]) -> String {
    let text = format!(
        "UNCORRECTED ACCELEROGRAM DATA\nA TEST\nCHAN  1: L        (STA CHN:  1)\n\
         UNIVERSIDAD DE CHILE - RENADIC\nNO. OF POINTS = {:6}  RECORD LENGTH = {:.3} SEC\n\
         UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  {:.9} G, AT  0.030 SEC\n",
        samples.len(),
        samples.len() as f64 * STEP,
        peak(samples).abs() / TENTHS / 10.0
    );
    let pairs: Vec<f64> =
        samples.iter().enumerate().flat_map(|(index, a)| [index as f64 * STEP, a / TENTHS]).collect();
    volume_1(&text, &pairs, |value| format!("{value:17.12}"))
}

/// Accelerations alone.
pub(crate) fn bhrc(samples: &[f64]) -> String {
    let text = format!(
        "* VOL1DS FILE:  9999/01\nL\nCOMP L1\nNO. OF POINTS = {:6}      DURATION = {:.3}\n\
         UNITS ARE SECONDS AND G/10\n",
        samples.len(),
        samples.len() as f64 * STEP
    );
    volume_1(&text, samples, |value| format!("{:20.12E}", value / TENTHS))
}

pub(crate) fn knet_csv(samples: &[f64]) -> String {
    let rows = rows(samples, |time, a| format!("2001/01/01 00:00:{:05.2},{time:.2},{a:.3}", 15.0 + time));
    format!(
        "#K-NET CSV\n#SamplingFrequency(Hz)\n#100\n#DurationTime(s)\n#{:.2}\n\
         #Time,RelativeTime(s),N-S(gal)\n{rows}",
        samples.len() as f64 * STEP
    )
}

/// Five numbers a line and nothing else.
pub(crate) fn numbers(samples: &[f64]) -> String {
    columns(samples, 5, |a| format!(" {a:.3}"))
}

fn rows(samples: &[f64], row: impl Fn(f64, f64) -> String) -> String {
    samples.iter().enumerate().map(|(index, &a)| row(index as f64 * STEP, a) + "\n").collect()
}

/// Places, lengths, kinds and new bytes of damages.
pub(crate) type Edits = Vec<(prop::sample::Index, usize, u8, Vec<u8>)>;

/// One to five damages.
pub(crate) fn edits() -> impl Strategy<Value = Edits> {
    let bytes = prop::collection::vec(any::<u8>(), 0..8);
    prop::collection::vec((any::<prop::sample::Index>(), 0..200_usize, any::<u8>(), bytes), 1..6)
}

/// A damaged copy of a text: parts removed, doubled, overwritten.
pub(crate) fn mutated(text: &str, edits: &Edits) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (place, length, kind, insert) in edits {
        if bytes.is_empty() {
            break;
        }
        let at = place.index(bytes.len());
        let end = (at + length).min(bytes.len());
        match kind % 4 {
            0 => drop(bytes.drain(at..end)),
            1 => drop(bytes.splice(at..end, insert.iter().copied())),
            2 => {
                let copy = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, copy));
            }
            _ => bytes.truncate(at),
        }
    }
    bytes
}
