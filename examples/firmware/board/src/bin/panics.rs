//! A program with a panic path, an index that is not checked before: it must not link.
#![no_std]
#![no_main]

use core::hint::black_box;

use firmware_board::print;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    print(&[b"ok"[black_box(1)]]);
    semihosting::process::exit(0)
}
