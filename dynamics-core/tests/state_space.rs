//! Linear models: their equation, and how they print.

use dynamics_core::prelude::*;

fn cart() -> StateSpace<f64, 2, 1, 1> {
    let model = StateSpace::from_matrices(
        [[0.0, -4.0], [1.0, -0.12345]].into(),
        [[0.0, 2.5e-4]].into(),
        [[1.0], [-123_456.0]].into(),
        [[0.5]].into(),
    );
    StateSpace {
        drift: [0.25, 0.0].into(),
        offset: [-1.0].into(),
        states: [Signal::new("slider", "m"), Signal::part("slider", "'", "m/s")],
        inputs: [Signal::new("slider", "N")],
        outputs: [Signal::part("tool0", ".x", "m")],
        ..model
    }
}

#[test]
fn rate_and_output_are_affine() {
    let (model, x, u) = (cart(), SVector::from([2.0, -1.0]), SVector::from([4.0]));
    assert_eq!(model.derivative(&x, &u), SVector::from([-1.0 + 0.25, -8.0 + 0.12345 + 1e-3]));
    assert_eq!(model.output(&x, &u), SVector::from([2.0 + 123_456.0 + 2.0 - 1.0]));
    assert_eq!(model.derivative(&SVector::zeros(), &SVector::zeros()), model.drift);
}

#[test]
fn a_linearization_is_a_model_whose_output_is_its_state() {
    let linear = Linearization {
        a: [[0.0, -4.0], [1.0, 0.0]].into(),
        b: [[0.0, 1.0]].into(),
        drift: [0.0, 3.0].into(),
    };
    let (model, x, u) = (StateSpace::from(linear), SVector::from([0.3, 0.7]), SVector::from([5.0]));
    assert_eq!(model.output(&x, &u), x);
    assert_eq!(model.derivative(&x, &u), linear.a * x + linear.b * u + linear.drift);
    assert_eq!(model.sample_time, None);
}

#[test]
fn it_prints_as_a_table() {
    let expected = "\
x' = A x + B u + drift, y = C x + D u + offset
                    slider     slider' |      slider |    constant
                         m         m/s |           N |
x' slider  m             0      1.0000 |           0 |      0.2500
x' slider' m/s     -4.0000     -0.1235 |    2.500e-4 |           0
y  tool0.x m        1.0000    -1.235e5 |      0.5000 |     -1.0000
";
    let printed = cart().to_string();
    assert_eq!(printed, expected, "\n{printed}");
}

#[test]
fn without_names_it_prints_indices() {
    let mut model = StateSpace::<f32, 1, 1, 1>::from_matrices(
        [[0.5]].into(),
        [[1.0]].into(),
        [[f32::NAN]].into(),
        [[0.0]].into(),
    );
    model.sample_time = Some(0.25);
    let expected = "\
x+ = A x + B u + drift, y = C x + D u + offset, every 0.25 s
                x[0] |        u[0] |    constant
x+ x[0]          0.5 |         1.0 |           0
y  y[0]          NaN |           0 |           0
";
    let printed = format!("{model:.1}");
    assert_eq!(printed, expected, "\n{printed}");
}
