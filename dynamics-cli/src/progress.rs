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

/// Something that takes its time. The line vanishes with it.
pub(crate) struct Progress {
    permille: Arc<AtomicU32>,
    watcher: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Begins to watch over the work that `what` names. Without a terminal nothing is ever said, nor where a log is
    /// kept of one, as continuous integration does, which sets `CI`.
    pub(crate) fn of(what: &str) -> Self {
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
                let percent = match done.load(Ordering::Relaxed) {
                    0 => String::new(),
                    permille => format!(" {} %,", permille / 10),
                };
                let _ = write!(std::io::stderr(), "\r\x1b[K{what}:{percent} {} s", start.elapsed().as_secs());
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

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, watcher)) = self.watcher.take() {
            drop(sender);
            let _ = watcher.join();
        }
    }
}
