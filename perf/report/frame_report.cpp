// Small sums over what a rendering showed.
#include "perf/report/frame_report.h"

#include <algorithm>

namespace halfframe::perf {

std::uint64_t CallReport::draws() const {
    std::uint64_t sum = 0;
    for (const CallsOfPass& pass : passes) {
        sum += pass.draws;
    }
    return sum;
}

CallReport call_report(const gl::CallLedger& ledger) {
    CallReport report;
    report.object_creations = ledger.object_creations();
    report.program_links = ledger.program_links();
    const auto& names = ledger.pass_names();
    for (std::size_t index = 0; index < names.size(); ++index) {
        const gl::PassCalls& counts = ledger.pass(static_cast<int>(index));
        if (counts.calls() == 0) {
            continue;
        }
        CallsOfPass pass{.pass = names[index],
                         .calls = counts.calls(),
                         .draws = counts.draws,
                         .vertices = counts.vertices,
                         .bytes_uploaded = counts.bytes_uploaded,
                         .bytes_read_back = counts.bytes_read_back,
                         .by_name = {}};
        for (int call = 0; call < gl::call_count(); ++call) {
            if (const std::uint32_t count = counts.count[static_cast<std::size_t>(call)]; count > 0) {
                pass.by_name.emplace_back(gl::call_name(call), count);
            }
        }
        std::sort(pass.by_name.begin(), pass.by_name.end());
        report.passes.push_back(std::move(pass));
    }
    return report;
}

std::size_t bytes_written(const FramePlan& plan, const Pass& pass) {
    std::size_t bytes = 0;
    if (pass.color && pass.writes_color) {
        bytes += plan.targets[static_cast<std::size_t>(*pass.color)].bytes();
    }
    if (pass.depth && pass.writes_depth) {
        bytes += plan.targets[static_cast<std::size_t>(*pass.depth)].bytes();
    }
    return bytes;
}

}  // namespace halfframe::perf
