// SPDX-License-Identifier: GPL-3.0-or-later
/// \file memory_reserve.hpp  Keeps memory in reserve for the moment when memory runs out.
#pragma once

namespace macadam {

/// Allocates a reserve of memory. If operator new later finds no memory, it frees the reserve and tries again, once in
/// the life of the program; after that it throws std::bad_alloc as usual. The program then has memory to end properly:
/// for the message, for the summary of the results so far, and for functions that allocate but may not throw
/// (destructors of JSON, the standard library's iterators over folders). GMP gets its memory from operator new too,
/// because its own allocator would end the program.
void keep_memory_in_reserve();

}  // namespace macadam
