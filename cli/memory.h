#pragma once

namespace dwell::cli {

/// Prepares the allocator for a program that makes and frees arrays of the map's size all the time and then ends: freed
/// memory is kept and used again, and the first gigabytes lie on huge pages where the system offers them. By default
/// each such array is new memory, which the system clears page by page; that takes a third of the time of a large plan.
/// Call it once, before anything large is allocated. It changes no result, and where the system does not support it
/// nothing happens.
void keep_freed_memory();

}  // namespace dwell::cli
