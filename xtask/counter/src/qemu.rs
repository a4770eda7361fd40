//! The border to QEMU: the few functions of its plugin interface that are needed, declared here so that no header is.
//!
//! The interface has versions. QEMU up to 8.2 speaks 1, which points at the bytes of an instruction; QEMU 9.1 and later
//! accept 3, which copies them (feature `api3`). All else that is used here is the same in both.

use crate::COUNTER;
use std::ffi::{c_char, c_int, c_uint, c_void, CStr};

/// Which version of the interface this is; QEMU reads it before anything else.
#[no_mangle]
#[allow(non_upper_case_globals)]
pub static qemu_plugin_version: c_int = if cfg!(feature = "api3") { 3 } else { 1 };

/// A block of code being translated.
#[repr(C)]
struct Block {
    _opaque: [u8; 0],
}

/// An instruction of a block.
#[repr(C)]
struct Instruction {
    _opaque: [u8; 0],
}

/// How `QEMU_PLUGIN_CB_NO_REGS` is numbered.
const NO_REGISTERS: c_int = 0;

extern "C" {
    fn qemu_plugin_register_vcpu_tb_trans_cb(id: u64, callback: extern "C" fn(u64, *mut Block));
    fn qemu_plugin_register_atexit_cb(id: u64, callback: extern "C" fn(u64, *mut c_void), data: *mut c_void);
    fn qemu_plugin_register_vcpu_insn_exec_cb(
        instruction: *mut Instruction,
        callback: extern "C" fn(c_uint, *mut c_void),
        flags: c_int,
        data: *mut c_void,
    );
    fn qemu_plugin_tb_n_insns(block: *const Block) -> usize;
    fn qemu_plugin_tb_get_insn(block: *const Block, index: usize) -> *mut Instruction;
    fn qemu_plugin_insn_vaddr(instruction: *const Instruction) -> u64;
    fn qemu_plugin_insn_size(instruction: *const Instruction) -> usize;
    #[cfg(feature = "api3")]
    fn qemu_plugin_insn_data(instruction: *const Instruction, to: *mut u8, length: usize) -> usize;
    #[cfg(not(feature = "api3"))]
    fn qemu_plugin_insn_data(instruction: *const Instruction) -> *const u8;
}

/// The address, size and first bytes of an instruction.
///
/// # Safety
/// `instruction` is one that QEMU gave, during the translation of its block.
unsafe fn look(instruction: *const Instruction) -> (u64, usize, [u8; 4]) {
    let mut code = [0; 4];
    // SAFETY: as above; no more bytes are taken than the instruction has.
    unsafe {
        let size = qemu_plugin_insn_size(instruction);
        #[cfg(feature = "api3")]
        qemu_plugin_insn_data(instruction, code.as_mut_ptr(), size.min(4));
        #[cfg(not(feature = "api3"))]
        qemu_plugin_insn_data(instruction).copy_to(code.as_mut_ptr(), size.min(4));
        (qemu_plugin_insn_vaddr(instruction), size, code)
    }
}

extern "C" fn translated(_id: u64, block: *mut Block) {
    let Ok(mut counter) = COUNTER.lock() else { return };
    // SAFETY: block and instructions are QEMU's, valid during this call; the number of the site rides in the data pointer.
    unsafe {
        for index in 0..qemu_plugin_tb_n_insns(block) {
            let instruction = qemu_plugin_tb_get_insn(block, index);
            let (address, size, code) = look(instruction);
            let site = counter.site(address, size, code);
            qemu_plugin_register_vcpu_insn_exec_cb(instruction, executed, NO_REGISTERS, site as *mut c_void);
        }
    }
}

extern "C" fn executed(_core: c_uint, site: *mut c_void) {
    if let Ok(mut counter) = COUNTER.lock() {
        counter.execute(site as usize);
    }
}

extern "C" fn ended(_id: u64, _data: *mut c_void) {
    let Ok(counter) = COUNTER.lock() else { return };
    if let Err(error) = counter.report().map_err(std::io::Error::other).and_then(|text| std::fs::write(&counter.out, text)) {
        eprintln!("counter: {}: {error}", counter.out);
    }
}

/// QEMU calls this once it has loaded the plugin; anything but 0 makes it give up.
///
/// # Safety
/// Called by QEMU, as its interface says: `info` begins with a pointer to the target's name, and `arguments` points to
/// `count` strings.
#[no_mangle]
pub unsafe extern "C" fn qemu_plugin_install(
    id: u64,
    info: *const *const c_char,
    count: c_int,
    arguments: *const *const c_char,
) -> c_int {
    // SAFETY: as above.
    let text = |string| unsafe { CStr::from_ptr(string) }.to_string_lossy().into_owned();
    // SAFETY: as above.
    let (target, arguments) =
        unsafe { (text(*info), (0..count as usize).map(|index| text(*arguments.add(index))).collect::<Vec<_>>()) };
    let Ok(mut counter) = COUNTER.lock() else { return 1 };
    if let Err(error) = counter.configure(&target, &arguments) {
        eprintln!("counter: {error}");
        return 1;
    }
    // SAFETY: the callbacks have the types that the interface asks for, and live as long as the plugin.
    unsafe {
        qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
        qemu_plugin_register_atexit_cb(id, ended, std::ptr::null_mut());
    }
    0
}
