//! What a linked program says about itself.

use anyhow::{anyhow, ensure, Context, Result};
use object::elf::{SHF_ALLOC, SHF_WRITE};
use object::{Architecture, Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind, SymbolKind};
use std::path::{Path, PathBuf};

/// A program for a microcontroller.
pub(crate) struct Elf {
    path: PathBuf,
    sizes: Sizes,
    /// By address.
    functions: Vec<Function>,
}

/// Bytes of what a program begins with.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sizes {
    /// Code and constants.
    pub(crate) text: u64,
    /// Static variables that begin with some value.
    pub(crate) data: u64,
    /// Static variables that begin with zero, or with nothing in particular.
    pub(crate) bss: u64,
}

/// A function, as the symbol table has it.
pub(crate) struct Function {
    pub(crate) address: u64,
    pub(crate) size: u64,
    pub(crate) name: String,
}

impl Elf {
    /// Reads the program's tables.
    ///
    /// # Errors
    /// If it is no program; among these, one that was linked without its linker script: it is empty, and begins at 0.
    pub(crate) fn open(path: &Path) -> Result<Elf> {
        let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
        let file = object::File::parse(&*bytes).with_context(|| path.display().to_string())?;
        ensure!(file.entry() != 0, "{} is empty: it was linked without its linker script", path.display());

        let mut sizes = Sizes::default();
        for section in file.sections() {
            let SectionFlags::Elf { sh_flags, .. } = section.flags() else { continue };
            match (sh_flags.contains(SHF_WRITE), section.kind() == SectionKind::UninitializedData) {
                _ if !sh_flags.contains(SHF_ALLOC) => {}
                (false, false) => sizes.text += section.size(),
                (true, false) => sizes.data += section.size(),
                (true, true) => sizes.bss += section.size(),
                // Places kept free, such as for the stack.
                (false, true) => {}
            }
        }

        // The lowest bit of the address of an Arm function tells that it is Thumb code.
        let thumb = u64::from(file.architecture() == Architecture::Arm);
        let symbols = file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.size() > 0);
        let mut functions: Vec<_> = symbols
            .map(|symbol| Function {
                address: symbol.address() & !thumb,
                size: symbol.size(),
                name: readable(symbol.name().unwrap_or("?")),
            })
            .collect();
        functions.sort_by_key(|function| function.address);
        functions.dedup_by_key(|function| function.address);
        Ok(Elf { path: path.to_owned(), sizes, functions })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Bytes that it takes in flash: code, constants, and what static variables begin with.
    pub(crate) fn flash_bytes(&self) -> u64 {
        self.sizes.text + self.sizes.data
    }

    /// Bytes by kind.
    pub(crate) fn sizes(&self) -> Sizes {
        self.sizes
    }

    /// Its functions, by address.
    pub(crate) fn functions(&self) -> &[Function] {
        &self.functions
    }

    /// The function that an address lies in.
    pub(crate) fn function(&self, address: u64) -> Option<&Function> {
        let after = self.functions.partition_point(|function| function.address <= address);
        let function = &self.functions[after.checked_sub(1)?];
        (address < function.address + function.size).then_some(function)
    }

    /// For ranges of addresses, start and end, what `classify` makes of the functions there: the innermost inlined one
    /// first, the one in the symbol table last. Ranges for which it says nothing are left out.
    ///
    /// # Errors
    /// If the program has no debug information.
    pub(crate) fn ranges<T: PartialEq>(&self, classify: impl Fn(&[String]) -> Option<T>) -> Result<Vec<(u64, u64, T)>> {
        let debug = addr2line::Loader::new(&self.path).map_err(|error| anyhow!("{}: {error}", self.path.display()))?;
        let mut ranges: Vec<(u64, u64, T)> = Vec::new();
        // Instructions begin at even addresses, on Arm and on RISC-V.
        let addresses =
            self.functions.iter().flat_map(|function| (function.address..function.address + function.size).step_by(2));
        for address in addresses {
            let mut names = Vec::new();
            let mut frames = debug.find_frames(address).map_err(|error| anyhow!("{error}"))?;
            while let Some(frame) = frames.next()? {
                names.extend(frame.function.and_then(|function| function.raw_name().ok().map(|name| readable(&name))));
            }
            let Some(class) = classify(&names) else { continue };
            match ranges.last_mut() {
                Some((_, end, last)) if *end == address && *last == class => *end += 2,
                _ => ranges.push((address, address + 2, class)),
            }
        }
        Ok(ranges)
    }
}

/// A name as it stands in the source, without the hash.
fn readable(name: &str) -> String {
    format!("{:#}", rustc_demangle::demangle(name))
}
