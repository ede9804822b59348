// One counter that all threads take their next piece from.
#include "content/environment/work_sharing.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

namespace halfframe::content {

void share_work(const std::vector<double>& costs, int threads, const std::function<void(std::size_t)>& job,
                const std::function<void(double)>& progress) {
    std::atomic<std::size_t> next{0};
    std::atomic<double> done{0.0};
    std::atomic<bool> stopped{false};
    std::mutex failure_lock;
    std::exception_ptr failure;
    const double total = std::accumulate(costs.begin(), costs.end(), 0.0);

    const auto work = [&](bool is_caller) {
        try {
            for (std::size_t piece = next++; piece < costs.size() && !stopped; piece = next++) {
                job(piece);
                const double share = (done += costs[piece]) / total;
                if (is_caller && progress) progress(std::min(share, 1.0));
            }
        } catch (...) {
            stopped = true;
            const std::lock_guard lock(failure_lock);
            if (!failure) failure = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (int i = 1; i < threads; ++i) {
            try {
                helpers.emplace_back(work, false);
            } catch (const std::system_error&) {
                break;  // the machine gives no more threads: the ones there are do the work
            }
        }
        work(true);
    }
    if (failure) std::rethrow_exception(failure);
    if (progress) progress(1.0);
}

}  // namespace halfframe::content
