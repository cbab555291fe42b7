//! A judgment states whether a claim holds in a run, with a sentence of evidence.

use crate::reproduce::run::Reading;
use crate::reproduce::{Results, Run};
use guideway_bench::{Dataset, Measured};

/// True if a claim holds, with the evidence; `None` when the run lacks the measurements.
pub(super) type Judgment = Option<(bool, String)>;

/// Joins the judgments per dataset: the claim must hold in each dataset that has one.
pub(super) fn in_all(each: impl IntoIterator<Item = Judgment>) -> Judgment {
    let judged: Vec<(bool, String)> = each.into_iter().flatten().collect();
    let sentences: Vec<&str> = judged.iter().map(|(_, text)| text.as_str()).collect();
    let evidence = sentences.join(" ");
    (!judged.is_empty()).then(|| (judged.iter().all(|(holds, _)| *holds), evidence))
}

/// The measurements of several methods at the largest number of paths that all of them drew.
pub(super) fn at_most_paths<'a, const N: usize>(
    run: &'a Run,
    dataset: Dataset,
    methods: [&str; N],
) -> Option<(usize, [&'a Measured; N])> {
    let curves = methods.map(|method| Results::curve(&run.results.growth, dataset, method));
    let at = |paths: usize| {
        let point = |curve: &Vec<(&'a Reading, &'a Measured)>| {
            curve
                .iter()
                .find(|(r, _)| r.paths == paths)
                .map(|&(_, m)| m)
        };
        let points: Vec<&'a Measured> = curves.iter().filter_map(point).collect();
        points.try_into().ok().map(|points| (paths, points))
    };
    curves[0]
        .iter()
        .rev()
        .find_map(|(reading, _)| at(reading.paths))
}
