//! Local unflipping: a conformal map with few flipped faces is changed around these and kept elsewhere.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use num_complex::Complex64;

use super::in_order::put_in_order;
use super::patch::{FacesAt, Patch};
use super::{Limits, SOLVER, Stage, middle_of_arc, minimise};
use crate::constraint::Freedoms;
use crate::distortion::{Image, face_maps};
use crate::energy::conformal::{self, Dirichlet, Weight};
use crate::energy::{Conformal, Energy, Gaps, Metric, Mips, Unfolding};
use crate::map::boundary_energy::{circle_energy, length_energy};
use crate::map::provenance::Provenance;
use crate::map::setup::Setup;
use crate::map::{Boundary, Domain, Ending, Exactly, Map, MapError, MapOptions, Valid};
use crate::problem::nonlinear::{Objective, Terms};
use crate::quad_graph::area_at_rest;
use crate::solver::{Observer, Repair, Status};
use crate::surface::UnionFind;

/// The coefficient of MIPS beside H, both measured on a disc of area π.
///
/// # Rationale
/// The smaller it is, the closer the map is to the conformal one. On 10⁴ jittered quads whose corners are opened to half a
/// turn the mean of σ1/σ2 is 1.0357, 1.0260, 1.0149 and the largest 7.25, 7.32, 7.26 for 0.1, 0.01, 0.001.
const SHARE_OF_MIPS: f64 = 1e-3;

/// The coefficient of the barrier between neighbours on the boundary: without it dual points come so close to each
/// other that steps jam.
const BARRIER: f64 = 1e-4;

/// The largest mean of σ1/σ2 for which the conformal map is kept around its flipped faces. Above it the best map of
/// these parts is seldom close to the conformal one.
const LARGEST_SHEAR: f64 = 1.05;

/// Faces with a larger σ1/σ2 are treated as if they were flipped.
const SHEARED: f64 = 4.0;

/// The largest share of flipped or distorted faces for which local unflipping is tried.
const LARGEST_SHARE_OF_FOLDS: f64 = 0.1;

/// The numbers of rings of faces around flipped faces that may move, tried in turn.
const RINGS: [usize; 3] = [4, 8, 16];

/// The largest share of the faces in a patch. Beyond it another map is computed instead.
const LARGEST_SHARE: f64 = 0.5;

/// The largest number of stages with decreasing ε of [`Unfolding`].
const STAGES: usize = 15;

/// The largest number of iterations of each of these stages.
const ITERATIONS: usize = 10;

/// The first ε, as a share of the target area of a triangle. With a large one all triangles shrink.
const FIRST_SHARE: f64 = 0.1;

/// The smallest ε, as a share of the target area of a triangle.
const SMALLEST_SHARE: f64 = 1e-10;

/// The largest number of iterations of the last stage.
const MOST_AT_LAST: usize = 100;

/// The least relative decrease of the energy by a step before the last stage.
const GAIN_ON_THE_WAY: f64 = 1e-2;

/// Unflips the map `plain` by moving vertices around its flipped faces. Returns the map, or `None` if that does not
/// suffice, and the number of iterations.
pub(super) fn around_flipped(
    setup: &Setup,
    plain: &Map,
    left: Option<usize>,
    watch: &mut dyn Observer,
) -> Result<(Option<Map>, usize), MapError> {
    let Setup { options, domain, .. } = *setup;
    if options.valid != Valid::Auto {
        return Ok((None, 0));
    }
    let count = domain.disc.faces.len() as f64;
    // Boundary points that are only drawn to the circle have no curve to slide on.
    if options.boundary.is_circle() && !matches!(plain.exactly, Some(Exactly::Circle | Exactly::Conformal)) {
        return Ok((None, 0));
    }
    let (sheared, mean) = shear(domain, &plain.z);
    if mean > LARGEST_SHEAR {
        return Ok((None, 0));
    }
    let at = FacesAt::new(domain);
    let mut seeds = seeds(options, domain, &at, &plain.z, sheared);
    if seeds.len() as f64 > LARGEST_SHARE_OF_FOLDS * count {
        return Ok((None, 0));
    }
    let work = Work {
        options,
        area: area_at_rest(&domain.disc, domain.planes.as_ref()),
        perimeter: domain.graph.perimeter(),
        left,
    };
    let incidence = domain.graph.incidence();
    let mut z = plain.z.clone();
    let (mut spent, mut status, mut squares) = (0, Status::Converged, 0.0);
    for rings in RINGS {
        let faces = at.around(domain, &seeds, rings);
        if faces.len() as f64 > LARGEST_SHARE * count {
            break;
        }
        let mut failed = Vec::new();
        // Each by itself: steps of one Newton iteration are as short as the worst part of all asks for.
        let parts = components(domain, &faces);
        let count = parts.len();
        for (k, faces) in parts.into_iter().enumerate() {
            watch.repair(Repair::Part { number: k + 1, count });
            let patch = Patch::new(domain, (&at, &incidence), faces, &plain.fixed);
            let (stage, iterations) = work.solve(&patch, patch.restrict(&z), spent, watch)?;
            spent = iterations;
            match stage {
                Some(stage) => {
                    patch.write(&stage.z, &mut z);
                    status = worse(status, stage.status);
                    squares += stage.gradient_norm.map_or(0.0, |g| g * g);
                }
                None => failed.extend(seeds.iter().copied().filter(|f| patch.faces.binary_search(f).is_ok())),
            }
        }
        seeds = failed;
        if seeds.is_empty() {
            break;
        }
    }
    if !setup.accepts(&z) || shear(domain, &z).1 > LARGEST_SHEAR {
        return Ok((None, spent));
    }
    let graph = &domain.graph;
    let h = conformal::value(graph, &conformal::weights(graph, options.weight)?, &z);
    let (name, other, exactly) = match options.boundary {
        Boundary::Circle { .. } => ("C", circle_energy(graph, &plain.fixed, &z), Some(Exactly::Circle)),
        // Boundary edges that have moved may have changed their lengths.
        _ => ("Lb", length_energy(graph, &z), None),
    };
    let map = Map {
        z,
        total: Some(h + other),
        energies: vec![("H", h), (name, other)],
        gradient_norm: Some(squares.sqrt()),
        provenance: Provenance { solver: SOLVER, ..plain.provenance },
        ending: Ending::Minimised(status),
        iterations: spent,
        residual: None,
        smallest_singular_value: None,
        exactly,
        epsilon: None,
        ..plain.clone()
    };
    Ok((Some(map), spent))
}

/// Groups the faces such that no two groups share a vertex; each group is ascending.
fn components(domain: &Domain, faces: &[u32]) -> Vec<Vec<u32>> {
    let polygon = |f: u32| domain.disc.faces.get(f as usize);
    let mut sets = UnionFind::new(domain.disc.positions.len());
    for &f in faces {
        polygon(f).windows(2).for_each(|pair| sets.unite(pair[0], pair[1]));
    }
    let mut groups: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &f in faces {
        groups.entry(sets.find(polygon(f)[0])).or_default().push(f);
    }
    groups.into_values().collect()
}

/// Returns the worse of two statuses.
fn worse(a: Status, b: Status) -> Status {
    let order = [Status::Interrupted, Status::MaxIterations, Status::Precision];
    order.into_iter().find(|status| a == *status || b == *status).unwrap_or(Status::Converged)
}

/// Returns the faces with σ1/σ2 above [`SHEARED`], and the mean of σ1/σ2 over the others.
fn shear(domain: &Domain, z: &[Complex64]) -> (Vec<u32>, f64) {
    let maps = face_maps(&domain.disc, &domain.graph, &Image::of_disc(z));
    let (mut sheared, mut sum, mut count) = (Vec::new(), 0.0, 0usize);
    for (f, map) in maps.iter().enumerate().filter(|(_, map)| map.has_shape()) {
        let ratio = map.quasi_conformal();
        if map.is_regular() && ratio <= SHEARED {
            sum += ratio;
            count += 1;
        } else {
            sheared.push(f as u32);
        }
    }
    (sheared, sum / count as f64)
}

/// Returns the faces that must change: `sheared`, the flipped ones, and on the circle those at boundary points that
/// are out of order.
fn seeds(options: &MapOptions, domain: &Domain, at: &FacesAt, z: &[Complex64], sheared: Vec<u32>) -> Vec<u32> {
    let disc = &domain.disc;
    let mut seeds = sheared;
    seeds.extend(domain.folded(z));
    if options.boundary.is_circle() {
        let n = disc.boundary.len();
        for k in 0..n {
            let [a, b] = [k, (k + 1) % n].map(|k| disc.boundary[k]);
            if (z[a as usize].conj() * z[b as usize]).im <= 0.0 {
                seeds.extend(at.get(a).iter().chain(at.get(b)));
            }
        }
    }
    seeds.sort_unstable();
    seeds.dedup();
    seeds
}

/// The data common to all patches.
struct Work<'a> {
    options: &'a MapOptions,
    /// The area of the whole surface.
    area: f64,
    /// The length of the whole boundary.
    perimeter: f64,
    /// The number of iterations left, if there is a limit.
    left: Option<usize>,
}

impl Work<'_> {
    /// Unflips a patch. Returns it, or `None`, and the number of iterations, including `spent` earlier ones.
    fn solve(
        &self,
        patch: &Patch,
        mut z: Vec<Complex64>,
        spent: usize,
        watch: &mut dyn Observer,
    ) -> Result<(Option<Stage>, usize), MapError> {
        if self.is_circle() && !put_in_order(patch, &mut z) {
            return Ok((None, spent));
        }
        let stage = self.unfold(patch, Stage { iterations: spent, ..Stage::start(z) }, watch)?;
        let mips = Mips::new(patch.rest(Weight::Integral))?;
        if !mips.value(&stage.z).is_finite() {
            return Ok((None, stage.iterations));
        }
        let stage = self.finish(patch, stage, mips, watch)?;
        let iterations = stage.iterations;
        Ok((Some(stage), iterations))
    }

    fn is_circle(&self) -> bool {
        self.options.boundary.is_circle()
    }

    fn objective(&self, patch: &Patch, terms: Terms, z: &[Complex64], whole: bool) -> Objective {
        let graph = &patch.graph;
        let mut on_circle = vec![false; graph.vertices];
        if self.is_circle() {
            graph.boundary.iter().for_each(|&v| on_circle[v as usize] = true);
        }
        let fixed = patch.fixed(z, |v| !whole && (graph.is_dual(v) || on_circle[v as usize]));
        let freedoms = match self.is_circle() && whole {
            true => Freedoms::sliding(graph.vertices, &fixed, &graph.boundary),
            false => Freedoms::new(graph.vertices, &fixed),
        };
        Objective { terms, freedoms, norm: Dirichlet::new(graph, Weight::Integral) }
    }

    /// Minimises energies that are finite for flipped faces and grow for them from stage to stage. Points on the circle
    /// stay where they are.
    fn unfold(&self, patch: &Patch, mut stage: Stage, watch: &mut dyn Observer) -> Result<Stage, MapError> {
        let mips = Mips::new(patch.rest(Weight::Integral))?;
        let triangles = Unfolding::triangles(patch.rest(Weight::Integral))?;
        let scale = scales(patch, &triangles.stretch(&stage.z));
        let mut share = FIRST_SHARE;
        for _ in 0..STAGES {
            if stage.is_over(self.left) || mips.value(&stage.z).is_finite() {
                break;
            }
            let unfolding = Unfolding::new(patch.rest(Weight::Integral), &scale, share)?;
            let objective = self.objective(patch, vec![(1.0, Box::new(unfolding))], &stage.z, false);
            let energy = |z: &[Complex64]| objective.terms[0].1.value(z);
            let before = energy(&stage.z);
            let limits = Limits { left: self.left, most: ITERATIONS, gain: GAIN_ON_THE_WAY };
            stage = minimise(&objective, stage, limits, watch)?;
            let after = energy(&stage.z);
            let lowest =
                triangles.area_ratios(&stage.z).iter().zip(&scale).map(|(j, s)| j / s).fold(f64::INFINITY, f64::min);
            // Garanzha et al. 2021, with σ the relative decrease of the energy; Newton steps achieve most of it.
            let gained = (1.0 - after / before).max(0.5);
            let root = f64::hypot(lowest, share);
            let chi = 0.5 * (lowest + root);
            let floor = (1.0 - gained) * chi;
            share = if lowest < floor { 2.0 * (floor * (floor - lowest)).sqrt() } else { SMALLEST_SHARE };
            share = share.max(SMALLEST_SHARE);
        }
        Ok(stage)
    }

    /// Minimises H and a little MIPS; for free maps also L'.
    fn finish(&self, patch: &Patch, mut stage: Stage, mips: Mips, watch: &mut dyn Observer) -> Result<Stage, MapError> {
        place_duals(patch, self.is_circle(), &mut stage.z);
        let unit = if self.is_circle() { PI / self.area } else { 1.0 };
        let mut terms: Terms = vec![(1.0, Box::new(Conformal::new(patch.rest(self.options.weight))?))];
        terms.push((SHARE_OF_MIPS * unit, Box::new(mips)));
        if self.is_circle() {
            terms.push((BARRIER, Box::new(Gaps::of(&patch.edges, &patch.graph.boundary_length, self.perimeter))));
        } else {
            let (edges, lengths) = (&patch.mesh_edges, &patch.mesh_lengths);
            let kept = Metric::of_boundary_edges(edges, lengths, self.perimeter, Weight::Integral);
            terms.push((1.0, Box::new(kept)));
        }
        let objective = self.objective(patch, terms, &stage.z, true);
        let limits = Limits { left: self.left, most: MOST_AT_LAST, gain: self.options.tolerance };
        minimise(&objective, stage, limits, watch)
    }
}

/// Estimates the target area ratio of each triangle: the largest of the mean ratios at its corners.
fn scales(patch: &Patch, stretch: &[f64]) -> Vec<f64> {
    let triangles = &patch.metric.triangles;
    let mut sums = vec![(0.0, 0.0); patch.graph.vertices];
    for (t, s) in triangles.iter().zip(stretch).filter(|(_, s)| **s > 0.0) {
        for &v in &t.vertices {
            let (sum, count) = &mut sums[v as usize];
            *sum += s.ln();
            *count += 1.0;
        }
    }
    let mean = |v: u32| {
        let (sum, count) = sums[v as usize];
        if count > 0.0 { f64::exp(sum / count) } else { 0.0 }
    };
    triangles.iter().map(|t| t.vertices.map(mean).into_iter().fold(f64::MIN_POSITIVE, f64::max)).collect()
}

/// Places dual vertices at the barycentres of their faces, and those on the boundary at midpoints.
fn place_duals(patch: &Patch, is_circle: bool, z: &mut [Complex64]) {
    let has_dual = patch.graph.primal < patch.graph.vertices;
    if !has_dual {
        return;
    }
    // The dual vertices of faces follow the vertices of the mesh; a face that moves has one triangle.
    let mut own = vec![Complex64::ZERO; patch.faces.len()];
    let mut moves = vec![false; patch.faces.len()];
    for (t, &k) in patch.metric.triangles.iter().zip(&patch.face_of_triangle) {
        own[k as usize] = t.vertices.iter().map(|&v| z[v as usize]).sum::<Complex64>() / 3.0;
        moves[k as usize] = true;
    }
    for k in (0..own.len()).filter(|&k| moves[k]) {
        z[patch.graph.primal + k] = own[k];
    }
    for pair in patch.edges.chunks(2) {
        let [[a, dual], [_, b]] = [pair[0], pair[1]];
        let [a, b] = [a, b].map(|v| z[v as usize]);
        z[dual as usize] = match is_circle {
            true => middle_of_arc(a, b),
            false => 0.5 * (a + b),
        };
    }
}
