//! What the programs beside it need of a board: a console, and what is done in a panic.
#![no_std]

#[cfg(target_os = "none")]
use core::panic::PanicInfo;

/// Writes to the debugger's console. It asks for no file and so cannot fail.
#[cfg(target_os = "none")]
pub fn print(text: &[u8]) {
    for &byte in text {
        semihosting::sys::arm_compat::sys_writec(byte);
    }
}

/// A debug build stops here. In a release build nothing may call it: `link/no_panic.x` has the linker say so.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    semihosting::process::abort()
}
