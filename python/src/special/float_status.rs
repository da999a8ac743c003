//! Floating-point status flags around a loop.

/// Puts the status flags back as they were. Lanes that are computed and thrown away raise flags
/// that say nothing about the values, and NumPy would warn of them; scipy.special raises none
/// either.
pub struct FloatStatus(u64);

impl FloatStatus {
    #[cfg(target_arch = "x86_64")]
    pub fn keep() -> FloatStatus {
        let mut status = 0u32;
        // SAFETY: stores the 32 bits of MXCSR at the pointer, and does nothing else.
        unsafe {
            std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut status, options(nostack, preserves_flags));
        }
        FloatStatus(status.into())
    }

    #[cfg(target_arch = "aarch64")]
    pub fn keep() -> FloatStatus {
        let status: u64;
        // SAFETY: reads the status register, and does nothing else.
        unsafe {
            std::arch::asm!("mrs {}, fpsr", out(reg) status, options(nomem, nostack, preserves_flags));
        }
        FloatStatus(status)
    }

    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    pub fn keep() -> FloatStatus {
        FloatStatus(0)
    }
}

impl Drop for FloatStatus {
    fn drop(&mut self) {
        #[cfg(target_arch = "x86_64")]
        {
            let status = self.0 as u32;
            // SAFETY: loads what `stmxcsr` stored: control bits that are in force, and flags.
            unsafe {
                std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const status, options(nostack, preserves_flags));
            }
        }
        #[cfg(target_arch = "aarch64")]
        // SAFETY: writes back what was read from the register.
        unsafe {
            std::arch::asm!("msr fpsr, {}", in(reg) self.0, options(nomem, nostack, preserves_flags));
        }
    }
}
