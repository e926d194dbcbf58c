// SPDX-License-Identifier: GPL-3.0-or-later
/// \file memory_reserve.hpp  Keeps memory in reserve for the moment when memory runs out.
#pragma once

namespace macadam {

/// From now on, an operator new that finds no memory frees a reserve and tries again, once in the life of the program;
/// after that it throws std::bad_alloc as usual. The program then has memory to end properly: for the message, for the
/// summary that says how far it came, and for functions that may not throw but allocate (destructors of JSON, the
/// standard library's iterators over folders). GMP gets its memory from operator new too, because its own allocator
/// would end the program.
void keep_memory_in_reserve();

}  // namespace macadam
