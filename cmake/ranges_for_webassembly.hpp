// Comes before every file of the WebAssembly build, whose C++ library (LLVM 13) has no algorithms of <ranges>.
#pragma once

#include <algorithm>
#include <range/v3/algorithm.hpp>

namespace std::ranges {
using ::ranges::adjacent_find, ::ranges::all_of, ::ranges::any_of, ::ranges::copy, ::ranges::copy_if, ::ranges::count,
    ::ranges::count_if, ::ranges::equal, ::ranges::find, ::ranges::find_if, ::ranges::for_each, ::ranges::is_sorted,
    ::ranges::lower_bound, ::ranges::max, ::ranges::max_element, ::ranges::min, ::ranges::min_element, ::ranges::minmax,
    ::ranges::minmax_element, ::ranges::move, ::ranges::none_of, ::ranges::sort, ::ranges::stable_sort,
    ::ranges::upper_bound;
}  // namespace std::ranges
