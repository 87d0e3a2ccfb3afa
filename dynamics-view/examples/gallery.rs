//! Every kind of chart, on pages in a folder: `cargo run -p dynamics-view --example gallery -- target/gallery`.

use std::path::PathBuf;

use dynamics_core::Energy;
use dynamics_view::{Chart, Figure, Plane};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).ok_or("say which folder to write to")?.into();
    std::fs::create_dir_all(&folder)?;
    for (name, figure) in pages() {
        std::fs::write(folder.join(format!("{name}.svg")), figure.svg()?)?;
    }
    Ok(())
}

fn pages() -> [(&'static str, Figure); 5] {
    let times: Vec<f64> = (0..=4000).map(|k| 0.0025 * f64::from(k)).collect();
    let swing = |size: f64, rate: f64, decay: f64| {
        times.iter().map(move |t| size * (-decay * t).exp() * (rate * t).cos()).collect::<Vec<_>>()
    };
    let speed = |size: f64, rate: f64, decay: f64| {
        let of =
            move |t: &f64| -size * (-decay * t).exp() * (decay * (rate * t).cos() + rate * (rate * t).sin());
        times.iter().map(of).collect::<Vec<_>>()
    };
    let energy: Vec<Energy<f64>> = times
        .iter()
        .map(|t| {
            let kinetic = 4.0 * (3.0 * t).sin().powi(2);
            let drift = 3e-12 * t * (1.0 + 0.3 * (6.0 * t).sin());
            Energy { kinetic, potential: -9.0 - kinetic + drift, elastic: 0.0 }
        })
        .collect();
    let swinging = Figure::new("Two links that swing")
        .with(
            Chart::over_time("angle", "rad", &times)
                .line("shoulder", swing(0.8, 4.0, 0.0))
                .line("elbow", swing(0.5, 9.0, 0.05)),
        )
        .with(
            Chart::over_time("speed", "rad/s", &times)
                .line("shoulder", speed(0.8, 4.0, 0.0))
                .line("elbow", speed(0.5, 9.0, 0.05)),
        )
        .with_all(Chart::energy(&times, &energy));

    let mut many = Chart::over_time("angle", "rad", &times);
    for k in 0..14 {
        let name = format!("leg_{}_{}", k / 3, ["hip_abduction", "hip_flexion", "knee"][k % 3]);
        many = many.line(&name, swing(0.2 + 0.02 * k as f64, 2.0 + 0.3 * k as f64, 0.4));
    }
    let constant = Chart::over_time("height", "m", &times).line("base", times.iter().map(|_| 0.42));
    let single = Chart::over_time("force", "N", &[0.0]).line("push", [2.5e6]);
    let odd = Figure::new("Many lines, a constant, and one point").with(many).with(constant).with(single);

    let phases = Figure::new("Phase portraits")
        .with(Chart::phase("theta", ["rad", "rad/s"], &swing(0.8, 4.0, 0.0), &speed(0.8, 4.0, 0.0)))
        .with(Chart::phase("elbow", ["rad", "rad/s"], &swing(0.5, 5.0, 0.3), &speed(0.5, 5.0, 0.3)));

    let open = [[4.0, 0.0], [-4.0, 0.0], [0.0, 0.0], [0.0, 0.0]];
    let closed = [[-2.0, 2.0], [-2.0, -2.0], [-3.0, 0.7], [-3.0, -0.7]];
    let continuous = Figure::new("A cart-pole, upright")
        .with(Chart::poles(Plane::Continuous).set("alone", open).set("with feedback", closed));
    let sampled = closed.map(|[re, im]: [f64; 2]| {
        let size = (0.1 * re).exp();
        [size * (0.1 * im).cos(), size * (0.1 * im).sin()]
    });
    let discrete = Figure::new("The same, sampled ten times a second").with(
        Chart::poles(Plane::Discrete).set("with feedback", sampled).set("ringing", [[0.2, 0.9], [0.2, -0.9]]),
    );
    [("swing", swinging), ("odd", odd), ("phase", phases), ("poles", continuous), ("sampled_poles", discrete)]
}
