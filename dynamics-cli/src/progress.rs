//! A line on the terminal for whoever waits more than a second.

use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long nothing is said.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often the line is written again.
const INTERVAL: Duration = Duration::from_millis(200);

/// How many characters a bar has.
const BAR: usize = 20;

/// Something that takes its time. The line vanishes with it.
pub(crate) struct Progress {
    permille: Arc<AtomicU32>,
    watcher: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Begins to watch over the work that `what` names. Without a terminal nothing is ever said, nor where a log is
    /// kept of one, as continuous integration does, which sets `CI`.
    pub(crate) fn of(what: &str) -> Self {
        Self::watched(what, None)
    }

    /// [`of`](Self::of) work of so many steps, with a bar, how many are made in a second, and how long it will take yet.
    pub(crate) fn of_steps(what: &str, steps: f64) -> Self {
        Self::watched(what, Some(steps))
    }

    fn watched(what: &str, steps: Option<f64>) -> Self {
        let permille = Arc::new(AtomicU32::new(0));
        if !std::io::stderr().is_terminal() || std::env::var_os("CI").is_some() {
            return Self { permille, watcher: None };
        }
        let (sender, receiver) = channel::<()>();
        let (what, done, start) = (what.to_owned(), Arc::clone(&permille), Instant::now());
        let watch = move || {
            let mut wait = PATIENCE;
            while receiver.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                wait = INTERVAL;
                let line = line(done.load(Ordering::Relaxed), start.elapsed(), steps);
                let _ = write!(std::io::stderr(), "\r\x1b[K{what}:{line}");
            }
            if wait == INTERVAL {
                let _ = write!(std::io::stderr(), "\r\x1b[K");
            }
        };
        Self { permille, watcher: Some((sender, std::thread::spawn(watch))) }
    }

    /// So much is done, between 0 and 1.
    pub(crate) fn done(&self, part: f64) {
        self.permille.store((1000.0 * part) as u32, Ordering::Relaxed);
    }
}

/// What is said when so many thousandths are done, of so many steps.
fn line(permille: u32, elapsed: Duration, steps: Option<f64>) -> String {
    let seconds = elapsed.as_secs();
    match (permille, steps) {
        (0, _) => format!(" {seconds} s"),
        (_, None) => format!(" {} %, {seconds} s", permille / 10),
        (_, Some(steps)) => {
            let (part, elapsed) = (f64::from(permille) / 1000.0, elapsed.as_secs_f64());
            let (rate, left) = (steps * part / elapsed, elapsed * (1.0 - part) / part);
            let full = (BAR as f64 * part) as usize;
            let bar = "#".repeat(full) + &".".repeat(BAR.saturating_sub(full));
            format!(" [{bar}] {} %, {rate:.2e} steps/s, {left:.0} s left", permille / 10)
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, watcher)) = self.watcher.take() {
            drop(sender);
            let _ = watcher.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::line;
    use std::time::Duration;

    #[test]
    fn a_line_says_what_is_known() {
        let seconds = Duration::from_secs;
        assert_eq!(line(0, seconds(2), None), " 2 s");
        assert_eq!(line(255, seconds(2), None), " 25 %, 2 s");
        assert_eq!(line(0, seconds(2), Some(1e6)), " 2 s");
        let said = line(250, seconds(3), Some(4e6));
        assert_eq!(said, " [#####...............] 25 %, 3.33e5 steps/s, 9 s left");
        assert!(line(1000, seconds(3), Some(4e6)).contains("[####################] 100 %"));
    }
}
