use super::shared::*;
use crate::common::*;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use riemap::constraint::{Fixed, Freedoms};
use riemap::energy::conformal::{self, Dirichlet, Weight};
use riemap::energy::energy;
use riemap::energy::{Conformal, Curvature, Energy, EnergyKind, SquareSum, jacobian};
use riemap::problem::nonlinear::{HessianAssembly, Objective};

#[test]
fn gradients_and_exact_hessians_are_the_derivatives_of_values() {
    let mut random = Random(1);
    for case in Case::all("sphere?n=3") {
        for weight in WEIGHTS {
            let held: Vec<bool> = (0..case.graph.vertices).map(|v| v % 5 == 0).collect();
            for energy in case.energies(weight, &held) {
                let x = real(&case.state(&mut random));
                let what = format!("{} {weight:?} {}", energy.name(), case.name);
                let value = |x: &DVector<f64>| DVector::from_element(1, energy.value(&complex(x)));
                let g = DMatrix::from_columns(&[gradient(energy.as_ref(), &complex(&x))]);
                assert_near(&differences(&x, STEP, value).transpose(), &g, DIFFERENCE, &what);
                let exact = hessian(energy.as_ref(), &complex(&x), Curvature::Exact);
                let differences = differences(&x, STEP, |x| gradient(energy.as_ref(), &complex(x)));
                assert_near(&differences, &exact, DIFFERENCE, &what);
            }
        }
    }
}

#[test]
fn gauss_newton_hessians_are_those_of_the_residuals_jacobian() {
    let mut random = Random(2);
    for case in Case::all("sphere?n=3") {
        for weight in WEIGHTS {
            let held: Vec<bool> = (0..case.graph.vertices).map(|v| v % 5 == 0).collect();
            for sum in case.square_sums(weight, &held) {
                let z = case.state(&mut random);
                let what = format!("{} {weight:?} {}", SquareSum::name(sum.as_ref()), case.name);
                let residuals = |x: &DVector<f64>| {
                    let z = complex(x);
                    let stencils = sum.stencils();
                    let pieces = (0..stencils.len()).flat_map(|e| {
                        let mut local = [Complex64::ZERO; 4];
                        for (local, &v) in local.iter_mut().zip(stencils.get(e)) {
                            *local = z[v as usize];
                        }
                        sum.residuals(e, &local)[..sum.residuals_per_piece()].to_vec()
                    });
                    DVector::from_vec(pieces.collect())
                };
                let j = DMatrix::from(&jacobian(sum.as_ref(), &z));
                assert_near(&differences(&real(&z), STEP, residuals), &j, DIFFERENCE, &what);
                // The same numbers, added up in another order.
                let row = energy(SquareSum::name(sum.as_ref())).unwrap();
                let made = row.make(case.rest(weight, &held)).unwrap();
                let gauss = hessian(made.as_ref(), &z, Curvature::GaussNewton);
                assert_near(&(2.0 * j.transpose() * &j), &gauss, 1e-13, &what);
                let r = residuals(&real(&z));
                let value = made.value(&z);
                assert!((r.norm_squared() - value).abs() <= 1e-13 * value, "{what}");
                // Bending: 2 Jᵀ r″ with r″ from second differences along d, relative error h² and 1e-16/h².
                let d: Vec<Complex64> = z.iter().map(|_| random.complex()).collect();
                let (x, h) = (real(&z), 1e-4);
                let second = (residuals(&(&x + h * real(&d))) - 2.0 * &r + residuals(&(&x - h * real(&d)))) / (h * h);
                let expected = 2.0 * j.transpose() * second;
                let mut bending = vec![Complex64::ONE; z.len()];
                made.add_bending(0.5, &z, &d, &mut bending);
                let bending = 2.0 * real(&bending.iter().map(|b| b - 1.0).collect::<Vec<_>>());
                // The Hessian bounds what cancels in the second differences.
                let apart = (bending - expected).amax();
                assert!(apart <= 1e-6 * (gauss.amax() + value), "{what}: {apart:e}");
            }
        }
    }
}

#[test]
fn polynomials_along_lines_are_the_energies_there() {
    let mut random = Random(3);
    for case in Case::all("torus-patch?n=4") {
        for weight in WEIGHTS {
            let held = vec![false; case.graph.vertices];
            for energy in case.energies(weight, &held) {
                let z = case.state(&mut random);
                let d: Vec<Complex64> = z.iter().map(|_| random.complex()).collect();
                let Some(polynomial) = energy.along(&z, &d) else {
                    assert!(["order", "gaps"].contains(&energy.name()));
                    continue;
                };
                for t in [-2.0, -0.3, 0.0, 1e-3, 0.5, 1.0, 3.0] {
                    let there: Vec<Complex64> = z.iter().zip(&d).map(|(z, d)| z + t * d).collect();
                    let (a, b) = (polynomial.at(t), energy.value(&there));
                    // Coefficients cancel where t d is opposed to z: by their own size at most.
                    let size: f64 = polynomial.0.iter().enumerate().map(|(k, c)| (c * t.powi(k as i32)).abs()).sum();
                    assert!((a - b).abs() <= 1e-13 * size, "{} {weight:?} {}: {t}", energy.name(), case.name);
                }
            }
        }
    }
}

#[test]
fn the_energy_h_is_the_one_of_the_linear_problem() {
    let mut random = Random(4);
    for case in Case::all("enneper?n=4") {
        for weight in WEIGHTS {
            let (Ok(w), z) = (conformal::weights(&case.graph, weight), case.state(&mut random)) else { continue };
            let held = vec![true; case.graph.vertices];
            let h = Conformal::new(case.rest(weight, &held)).unwrap();
            let (a, b) = (h.value(&z), conformal::value(&case.graph, &w, &z));
            assert!((a - b).abs() <= 1e-14 * b, "{}", case.name);
            let product = conformal::normal_product(&case.graph, &w, &z);
            let g = gradient(&h, &z);
            // Sums of a dozen terms a vertex.
            assert!((2.0 * real(&product) - &g).amax() <= 1e-14 * g.amax() * 10.0, "{}", case.name);
        }
    }
}

/// Energies, held vertices and vertices on lines, quads and triangles.
#[test]
fn objectives_have_the_derivatives_of_their_values_in_the_unknowns_that_are_left() {
    let mut random = Random(5);
    for case in Case::all("sphere?n=3") {
        for weight in WEIGHTS {
            let z = case.state(&mut random);
            let mut fixed = Fixed::default();
            for v in (0..case.graph.vertices as u32).step_by(7) {
                fixed.hold(v, z[v as usize]);
            }
            // Neighbours on lines too; a place has the last word where a vertex has both.
            for v in (0..case.graph.vertices as u32).filter(|v| [1, 2, 5].contains(&(v % 7))) {
                fixed.hold_on_line(v, z[v as usize], z[v as usize] + random.complex() + 2.0);
            }
            fixed.hold_on_line(7, Complex64::ZERO, Complex64::I);
            let held: Vec<bool> = (0..case.graph.vertices as u32).map(|v| fixed.holds(v)).collect();
            let energies = case.energies(weight, &held);
            let terms = energies.into_iter().enumerate().map(|(k, e)| (0.3 + 0.4 * k as f64, e)).collect();
            let freedoms = Freedoms::new(case.graph.vertices, &fixed);
            let objective = Objective { terms, freedoms, norm: Dirichlet::new(&case.graph, weight) };
            let y = objective.freedoms.restrict(&z);
            let m = objective.freedoms.unknowns();
            assert!(largest_difference(&z, &objective.freedoms.expand(&y)) < 1e-15);

            // The chain of vertices to unknowns, column by column.
            let unit = |k: usize| (0..m).map(|j| f64::from(u8::from(j == k))).collect::<Vec<_>>();
            let columns: Vec<_> = (0..m).map(|k| real(&objective.freedoms.expand_direction(&y, &unit(k)))).collect();
            let chain = DMatrix::from_columns(&columns);
            let y = DVector::from_vec(y);
            let x = differences(&y, STEP, |y| real(&objective.freedoms.expand(y.as_slice())));
            assert_near(&x, &chain, 1e-10, &case.name);

            let gradient = |y: &DVector<f64>| DVector::from_vec(objective.gradient(y.as_slice()));
            let value = |y: &DVector<f64>| DVector::from_element(1, objective.value(y.as_slice()));
            let g = DMatrix::from_columns(&[gradient(&y)]);
            assert_near(&differences(&y, STEP, value).transpose(), &g, DIFFERENCE, &case.name);

            let assembly = HessianAssembly::new(&objective);
            let dense = |values: &[f64]| dense(&assembly, values);
            assert_eq!(assembly.columns().size(), m);
            let exact = dense(&assembly.values(y.as_slice(), Curvature::Exact));
            assert_near(&differences(&y, STEP, gradient), &exact, DIFFERENCE, &case.name);
            let mut gauss = DMatrix::zeros(2 * z.len(), 2 * z.len());
            for (t, energy) in &objective.terms {
                gauss += *t * hessian(energy.as_ref(), &z, Curvature::GaussNewton);
            }
            let assembled = dense(&assembly.values(y.as_slice(), Curvature::GaussNewton));
            assert_near(&(chain.transpose() * gauss * &chain), &assembled, 1e-12, &case.name);

            let norm = dense(&assembly.norm_values(y.as_slice())).symmetric_eigenvalues();
            // Positive semi-definite; unit weights stand in where Re ρ ≤ 0, and with them D stays so only for Re ρ > 0.
            let smallest = norm.min();
            assert!(smallest > -1e-12 * norm.max(), "{} {weight:?}: {smallest:e}", case.name);
        }
    }
}

/// Vertices that slide on the circle, some of them held: angles for unknowns.
#[test]
fn objectives_have_the_derivatives_of_their_values_in_angles_too() {
    let mut random = Random(9);
    for case in Case::all("sphere?n=3") {
        for holds in [0, 1, 3] {
            let mut z = case.state(&mut random);
            for &v in &case.graph.boundary {
                z[v as usize] = Complex64::cis(z[v as usize].arg());
            }
            let mut fixed = Fixed::default();
            for k in 0..holds {
                let v = case.graph.boundary[1 + 2 * k];
                fixed.hold(v, z[v as usize]);
            }
            let held = vec![false; case.graph.vertices];
            let energies = case.energies(Weight::Unit, &held);
            let terms = energies.into_iter().enumerate().map(|(k, e)| (0.3 + 0.4 * k as f64, e)).collect();
            let freedoms = Freedoms::sliding(case.graph.vertices, &fixed, &case.graph.boundary);
            let objective = Objective { terms, freedoms, norm: Dirichlet::new(&case.graph, Weight::Unit) };
            let y = objective.freedoms.restrict(&z);
            assert!(largest_difference(&z, &objective.freedoms.expand(&y)) < 1e-14);
            assert!(objective.freedoms.is_in_order(&y) && objective.freedoms.slides());
            assert_eq!(objective.freedoms.angles().count(), case.graph.boundary.len() - holds);
            let m = objective.freedoms.unknowns();
            let unit = |k: usize| (0..m).map(|j| f64::from(u8::from(j == k))).collect::<Vec<_>>();
            let columns: Vec<_> = (0..m).map(|k| real(&objective.freedoms.expand_direction(&y, &unit(k)))).collect();
            let chain = DMatrix::from_columns(&columns);
            let y = DVector::from_vec(y);
            let x = differences(&y, STEP, |y| real(&objective.freedoms.expand(y.as_slice())));
            assert_near(&x, &chain, 1e-9, &case.name);
            let gradient = |y: &DVector<f64>| DVector::from_vec(objective.gradient(y.as_slice()));
            let value = |y: &DVector<f64>| DVector::from_element(1, objective.value(y.as_slice()));
            let g = DMatrix::from_columns(&[gradient(&y)]);
            assert_near(&differences(&y, STEP, value).transpose(), &g, DIFFERENCE, &case.name);
            let assembly = HessianAssembly::new(&objective);
            let exact = dense(&assembly, &assembly.values(y.as_slice(), Curvature::Exact));
            assert_near(&differences(&y, STEP, gradient), &exact, DIFFERENCE, &case.name);
            let mut gauss = DMatrix::zeros(2 * z.len(), 2 * z.len());
            for (t, energy) in &objective.terms {
                gauss += *t * hessian(energy.as_ref(), &z, Curvature::GaussNewton);
            }
            // And the bend of the circle, where it is towards a minimum.
            let mut gauss = chain.transpose() * gauss * &chain;
            let at = objective.freedoms.expand(y.as_slice());
            let mut g = vec![Complex64::ZERO; at.len()];
            objective.terms.iter().for_each(|(t, energy)| energy.add_gradient(*t, &at, &mut g));
            for (v, k) in objective.freedoms.angles() {
                gauss[(k, k)] -= (at[v].conj() * g[v]).re.min(0.0);
            }
            let assembled = dense(&assembly, &assembly.values(y.as_slice(), Curvature::GaussNewton));
            assert_near(&gauss, &assembled, 1e-12, &case.name);
            // In order up to the largest step, and the energy is infinite past it.
            let closing: Vec<f64> = y.iter().map(|_| random.real()).collect();
            let step = objective.freedoms.largest_step(y.as_slice(), &closing);
            let at = |t: f64| y.iter().zip(&closing).map(|(y, p)| y + t * p).collect::<Vec<_>>();
            assert!(step.is_finite() && objective.freedoms.is_in_order(&at(0.999 * step)));
            assert_eq!(objective.value(&at(1.001 * step)), f64::INFINITY);
        }
    }
}

fn dense(assembly: &HessianAssembly, values: &[f64]) -> DMatrix<f64> {
    let columns = assembly.columns();
    let mut dense = DMatrix::zeros(columns.size(), columns.size());
    for column in 0..columns.size() {
        for entry in columns.entries(column) {
            let row = columns.rows[entry] as usize;
            assert!(row >= column);
            (dense[(row, column)], dense[(column, row)]) = (values[entry], values[entry]);
        }
    }
    dense
}
