//! How a program starts, prints and ends on a target: all that differs between targets.

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod semihosting;
#[cfg(all(target_arch = "arm", target_os = "none"))]
pub use semihosting::{exit, print};

#[cfg(all(target_arch = "riscv32", target_os = "none"))]
mod system_calls;
#[cfg(all(target_arch = "riscv32", target_os = "none"))]
pub use system_calls::{exit, print};

#[cfg(target_arch = "wasm32")]
mod exported;
#[cfg(target_arch = "wasm32")]
pub use exported::{exit, print};

#[cfg(not(any(target_os = "none", target_arch = "wasm32")))]
mod hosted;
#[cfg(not(any(target_os = "none", target_arch = "wasm32")))]
pub use hosted::{exit, print};

/// Defines the start of a program that ends by [`exit`].
#[macro_export]
macro_rules! start {
    ($run:path) => {
        /// The processor starts here.
        #[cfg(all(target_arch = "arm", target_os = "none"))]
        #[cortex_m_rt::entry]
        fn main() -> ! {
            $crate::platform::exit($run())
        }

        /// Linux starts here, or an emulator of it.
        #[cfg(all(target_arch = "riscv32", target_os = "none"))]
        #[allow(unsafe_code)]
        #[unsafe(no_mangle)]
        extern "C" fn _start() -> ! {
            $crate::platform::exit($run())
        }

        /// The host of a module calls this.
        #[cfg(target_arch = "wasm32")]
        #[allow(unsafe_code)]
        #[unsafe(export_name = "run")]
        extern "C" fn called_by_the_host() -> bool {
            $crate::platform::exit($run())
        }

        #[cfg(target_arch = "wasm32")]
        fn main() {}

        #[cfg(not(any(target_os = "none", target_arch = "wasm32")))]
        fn main() {
            $crate::platform::exit($run())
        }
    };
}
