//! From a request to its answer.

use rocking_wall::simulation::Excitation;
use run::page;
use scene::response::Response;
use serde_json::{Value, json};

use crate::charts::{Frames, captions, charts, file, inline};
use crate::check;
use crate::fragility::Fragility;
use crate::parameters;
use crate::request::{Faults, Inputs, Request, fault_of};
use crate::scene::{Prepared, prepare};
use crate::upload::Upload;
use crate::verdict::{facts, verdict};

/// What the page has asked for so far.
#[derive(Default)]
pub struct Session {
    upload: Upload,
    last: Option<(Prepared, Response)>,
    fragility: Option<Fragility>,
}

impl Session {
    /// Keeps the bytes of a record file for the runs that follow.
    pub fn keep_record(&mut self, bytes: Vec<u8>) {
        self.upload = Upload::new(bytes);
    }

    /// Answers a request in JSON with JSON: `{"answer": …}`, or `{"faults": {field: message}}`.
    pub fn answer(&mut self, request: &str) -> String {
        let answer = match serde_json::from_str(request) {
            Ok(Request::Parameters) => Ok(parameters::described()),
            Ok(Request::Unused(fields)) => Ok(parameters::unused(&fields)),
            Ok(Request::Run(inputs)) => self.run(&inputs),
            Ok(Request::Frames) => return self.frames(),
            Ok(Request::Fragility(inputs)) => self.start_fragility(&inputs),
            Ok(Request::NextMotion) => self.next_motion(),
            Ok(Request::Csv) => self.last().map(|(_, response)| response.csv().into()),
            Ok(Request::Svg) => self.last().map(|(prepared, response)| {
                file(charts(&prepared.wall, response, run::figure::WIDTH)).into()
            }),
            Ok(Request::Report(language)) => {
                self.last().and_then(|(prepared, _)| check::report(prepared, language))
            }
            // the page writes its requests itself
            Err(_) => Err(fault_of("request", "the page asks for what it cannot compute; load it again")),
        };
        match answer {
            Ok(answer) => json!({ "answer": answer }).to_string(),
            Err(faults) => json!({ "faults": faults }).to_string(),
        }
    }

    /// The frames of the last run; apart from its other numbers, which keep all their digits.
    fn frames(&self) -> String {
        let frames = self.last.as_ref().map(|(prepared, response)| Frames::of(&prepared.wall, response));
        format!("{{\"answer\":{}}}", serde_json::to_string(&frames).unwrap_or_default())
    }

    fn last(&self) -> Result<&(Prepared, Response), Faults> {
        self.last.as_ref().ok_or_else(|| fault_of("wall", "nothing has run yet"))
    }

    fn run(&mut self, inputs: &Inputs) -> Result<Value, Faults> {
        let prepared = prepare(inputs, &mut self.upload)?;
        let response = Response::of(&prepared.scene).map_err(|error| fault_of("wall", error.to_string()))?;
        let (scene, wall) = (&prepared.scene, &prepared.wall);
        let (body, summary) = (wall.body(), &response.summary);
        let mut warnings: Vec<String> = response.warnings.iter().map(ToString::to_string).collect();
        let of_motion = scene.excitation.as_ref().and_then(Excitation::warning);
        warnings.extend(of_motion.map(|warning| warning.to_string()));
        if summary.put_to_rest {
            warnings
                .push("the limit on impacts in one step was reached: the wall was put to rest".to_owned());
        }
        let peak = response.demands.displacement.largest();
        let answer = json!({
            "verdict": verdict(scene, wall, &response),
            "facts": facts(scene, wall, &response),
            "warnings": warnings,
            "computed": parameters::computed(wall),
            "check": check::checked(inputs, &scene.parameters),
            "charts": inline(charts(wall, &response, inputs.width)),
            "captions": captions(wall, &response),
            "drawing": page::drawing(scene, wall, &response),
            "factor": page::factor(wall, &response),
            "wall": {
                "height": body.height,
                "thickness": scene.parameters.thickness,
                "hinge": body.hinge(),
                "full": wall.rotations().is_some(),
                "shape": page::shape(wall, &scene.parameters),
                "u_ins": [body.instability.positive, body.instability.negative],
            },
            "summary": {
                "u_max": summary.u_max,
                "falls": summary.fate.falling(),
                "peak_time": peak.time,
            },
            "toml": prepared.toml,
        });
        self.last = Some((prepared, response));
        Ok(answer)
    }

    fn start_fragility(&mut self, inputs: &Inputs) -> Result<Value, Faults> {
        let Prepared { scene, .. } = prepare(inputs, &mut self.upload)?;
        let peak = scene.excitation.as_ref().map(|excitation| excitation.bottom().peak());
        let fragility = Fragility::new(scene.parameters, peak);
        self.fragility = Some(fragility.map_err(|message| fault_of("fragility", message))?);
        Ok(Value::Null)
    }

    fn next_motion(&mut self) -> Result<Value, Faults> {
        let Some(fragility) = &mut self.fragility else {
            return Err(fault_of("fragility", "no fragility has been started"));
        };
        fragility.next().map_err(|message| fault_of("fragility", message))
    }
}
