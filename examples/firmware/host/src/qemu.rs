//! QEMU: what a program prints, and every instruction that it executes.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::Result;
use crate::cargo::Target;

/// A board that QEMU plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Machine {
    CortexM4,
    CortexM7,
    RiscV,
}

impl Machine {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::CortexM4 => "mps2-an386",
            Self::CortexM7 => "mps2-an500",
            Self::RiscV => "virt",
        }
    }

    pub(crate) fn target(self) -> Target {
        match self {
            Self::CortexM4 | Self::CortexM7 => Target::Arm,
            Self::RiscV => Target::RiscV,
        }
    }

    pub(crate) fn program(self) -> &'static str {
        match self {
            Self::CortexM4 | Self::CortexM7 => "qemu-system-arm",
            Self::RiscV => "qemu-system-riscv32",
        }
    }

    /// What QEMU is started with for a program whose console is the standard output.
    fn command(self, program: &Path) -> Command {
        let mut command = Command::new(self.program());
        command.args(["-machine", self.name(), "-display", "none", "-monitor", "none", "-serial", "none"]);
        command.args([
            "-chardev",
            "stdio,id=console",
            "-semihosting-config",
            "enable=on,target=native,chardev=console",
        ]);
        if self == Self::RiscV {
            command.args(["-bios", "none"]);
        }
        command.arg("-kernel").arg(program).stdin(Stdio::null());
        command
    }

    /// Whether it is installed.
    pub(crate) fn is_there(self) -> bool {
        Command::new(self.program())
            .arg("--version")
            .stdout(Stdio::null())
            .status()
            .is_ok_and(|status| status.success())
    }
}

/// What the program prints until it ends.
pub(crate) fn run(machine: Machine, program: &Path) -> Result<String> {
    let output =
        machine.command(program).output().map_err(|error| format!("{}: {error}", machine.program()))?;
    if !output.status.success() {
        let (name, error) = (program.display(), String::from_utf8_lossy(&output.stderr));
        return Err(format!("{name} ended with {} on {}: {error}", output.status, machine.name()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).replace('\r', ""))
}

/// Before an instruction, or before a block of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Moment {
    /// The address of the instruction.
    pub(crate) pc: u32,
    /// The stack pointer, where the log has it.
    pub(crate) sp: Option<u32>,
}

/// What is logged of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Log {
    /// The address of each instruction.
    Addresses,
    /// Address and registers, for each instruction.
    Registers,
    /// Address and registers, where a block without branches begins.
    RegistersOfBlocks,
}

impl Log {
    /// QEMU translates one instruction at a time with `-singlestep`, one block without; it logs before it executes.
    fn arguments(self) -> &'static [&'static str] {
        match self {
            Self::Addresses => &["-singlestep", "-d", "exec,nochain"],
            Self::Registers => &["-singlestep", "-d", "cpu,nochain"],
            Self::RegistersOfBlocks => &["-d", "cpu,nochain"],
        }
    }
}

/// Runs the program, and tells of each moment of it in their order.
pub(crate) fn trace(machine: Machine, program: &Path, log: Log, each: impl FnMut(Moment)) -> Result<()> {
    let failed = |error: std::io::Error| format!("{}: {error}", machine.program());
    let mut command = machine.command(program);
    command.args(log.arguments()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    if let Some(log) = child.stderr.take() {
        read_trace(log, each).map_err(failed)?;
    }
    let status = child.wait().map_err(failed)?;
    if status.success() { Ok(()) } else { Err(format!("{} ended with {status}", program.display())) }
}

fn read_trace(log: impl Read, mut each: impl FnMut(Moment)) -> std::io::Result<()> {
    let mut log = BufReader::with_capacity(1 << 20, log);
    let (mut line, mut pc) = (vec![], 0);
    loop {
        line.clear();
        if log.read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        let value = |from: usize| line.get(from..from + 8).map_or(0, hexadecimal);
        if line.starts_with(b"Trace ") {
            // Trace 0: 0x7ff284000100 [00000000/00001000/00109003/ff000201]
            let bracket = line.iter().position(|&byte| byte == b'[').unwrap_or_default();
            each(Moment { pc: value(bracket + 10), sp: None });
        } else if line.starts_with(b"R12=") {
            // R12=00000000 R13=20030000 R14=00000405 R15=0001232e
            each(Moment { pc: value(43), sp: Some(value(17)) });
        } else if line.starts_with(b" pc ") {
            //  pc       80000000
            pc = value(10);
        } else if line.starts_with(b" x0/zero") {
            //  x0/zero  00000000 x1/ra    80000008 x2/sp    80400000 x3/gp    00000000
            each(Moment { pc, sp: Some(value(46)) });
        }
    }
}

fn hexadecimal(digits: &[u8]) -> u32 {
    digits.iter().fold(0, |value, &digit| value << 4 | char::from(digit).to_digit(16).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_log_is_read() {
        let log = "Trace 0: 0x7ff284000100 [00000000/00001000/00109003/ff000201] main\n\
                   R12=00000000 R13=20030000 R14=00000405 R15=0001232e\n\
                   XPSR=41000000 -Z-- T priv-thread\n pc       80000abc\n \
                   x0/zero  00000000 x1/ra    80000008 x2/sp    80400000 x3/gp    00000000\n";
        let mut moments = vec![];
        assert!(read_trace(log.as_bytes(), |moment| moments.push(moment)).is_ok());
        let moment = |pc, sp| Moment { pc, sp };
        let expected = [(0x1000, None), (0x1232e, Some(0x2003_0000)), (0x8000_0abc, Some(0x8040_0000))];
        assert_eq!(moments, expected.map(|(pc, sp)| moment(pc, sp)));
    }
}
