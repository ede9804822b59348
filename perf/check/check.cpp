// Runs every part of the check.
#include "perf/check/check.h"

#include <algorithm>

namespace halfframe::check {

std::size_t Report::count(Level level) const {
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                  [&](const Finding& finding) { return finding.level == level; }));
}

Report check_scene(const Scene& scene, const Request& request) {
    Report report;
    report.scene = request.file.empty() ? scene.name : request.file.string();
    report.device = request.device;
    const Places places(scene, request.file);
    check_materials(scene, request, places, report);
    check_textures(scene, request, places, report);
    check_meshes(scene, request, places, report);
    check_storage(scene, request, report);
    if (!request.file.empty()) check_file_normals(request, report);
    std::stable_sort(report.findings.begin(), report.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.level > b.level; });
    return report;
}

}  // namespace halfframe::check
