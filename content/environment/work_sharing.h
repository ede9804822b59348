// Work cut into independent pieces, shared by some threads.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace halfframe::content {

/// Runs job(0), ..., job(costs.size() - 1), each once, in no fixed order, on `threads` threads with the caller's. After
/// every piece of its own the caller hears progress(0..1), the share of the costs that is done. What `progress` or a
/// job throws stops the others at their next piece and comes out of here.
void share_work(const std::vector<double>& costs, int threads, const std::function<void(std::size_t)>& job,
                const std::function<void(double)>& progress);

}  // namespace halfframe::content
