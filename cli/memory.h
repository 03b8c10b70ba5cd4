#pragma once

namespace dwell::cli {

/// Sets the allocator up for a program that makes and drops arrays of the map's size all the time and then ends: what
/// is freed is kept and used again, and the first gigabytes are backed by huge pages where the system offers them. By
/// default each such array is new memory from the system, which clears it page by page: a third of the time of a large
/// plan. Call once, before anything large is allocated. Changes no result; where it cannot be done nothing happens.
void keep_freed_memory();

}  // namespace dwell::cli
