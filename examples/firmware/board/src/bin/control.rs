//! The control loop, printing its torques.
#![no_std]
#![no_main]

use firmware_control::report::Printer;
use firmware_control::trial;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    trial::all::<f32>(&mut Printer::new(firmware_board::print));
    semihosting::process::exit(0)
}
