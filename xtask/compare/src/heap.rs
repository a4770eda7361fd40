//! The heap of a peer that allocates: the cheapest there is, so that nobody pays for it.
//!
//! What is freed is given back only when nothing is in use any more, or when it was the last that was given out. The most bytes that
//! were in use at once are those of an allocator that wastes nothing.

use core::alloc::{GlobalAlloc, Layout};
use core::cell::UnsafeCell;
use core::ptr::null_mut;

const SIZE: usize = 2 << 20;

/// The heap of this program.
#[global_allocator]
static HEAP: Heap = Heap(UnsafeCell::new(Memory { bytes: [0; SIZE], top: 0, used: 0, most: 0 }));

struct Heap(UnsafeCell<Memory>);

#[repr(C, align(16))]
struct Memory {
    bytes: [u8; SIZE],
    /// Where the free bytes begin.
    top: usize,
    used: usize,
    most: usize,
}

// SAFETY: one core runs, and no interrupt is enabled.
unsafe impl Sync for Heap {}

// SAFETY: what is given out lies in `bytes`, aligned, and is not given out again before all was freed or it was freed as the last.
unsafe impl GlobalAlloc for Heap {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: nobody else holds a reference to the memory: see `Sync`.
        let memory = unsafe { &mut *self.0.get() };
        let begin = memory.top.next_multiple_of(layout.align());
        if SIZE.saturating_sub(begin) < layout.size() {
            return null_mut();
        }
        memory.top = begin + layout.size();
        memory.used += layout.size();
        memory.most = memory.most.max(memory.used);
        (&raw mut memory.bytes).cast::<u8>().wrapping_add(begin)
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as above.
        let memory = unsafe { &mut *self.0.get() };
        let begin = place.addr() - (&raw const memory.bytes).addr();
        memory.used -= layout.size();
        if memory.used == 0 {
            memory.top = 0;
        } else if begin + layout.size() == memory.top {
            memory.top = begin;
        }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above.
        let memory = unsafe { &mut *self.0.get() };
        let begin = place.addr() - (&raw const memory.bytes).addr();
        if begin + layout.size() == memory.top && begin + size <= SIZE {
            // The last that was given out grows where it is.
            memory.top = begin + size;
            memory.used = memory.used - layout.size() + size;
            memory.most = memory.most.max(memory.used);
            return place;
        }
        // SAFETY: the caller's promises are those of `alloc` and `dealloc`; the old and the new place do not overlap.
        unsafe {
            let new = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
            if !new.is_null() {
                new.copy_from_nonoverlapping(place, layout.size().min(size));
                self.dealloc(place, layout);
            }
            new
        }
    }
}

/// The most bytes that were ever in use.
pub(crate) fn most() -> usize {
    // SAFETY: as above.
    unsafe { (*HEAP.0.get()).most }
}
