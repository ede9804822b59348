// Everything that one rendering of one scene showed, as plain data: what the tables, the JSON and the page are made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/budget.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/image.h"
#include "engine/frame/pass_timer.h"
#include "engine/frame/renderer.h"
#include "engine/gl/call_ledger.h"
#include "engine/gl/caps.h"
#include "engine/gl/program.h"
#include "perf/report/modelled.h"

namespace halfframe::perf {

/// What the steady frame and the set-up did to GL.
struct CallsOfPass {
    std::string pass;  ///< a pass name, "set-up" for what is outside every pass
    std::uint64_t calls = 0;
    std::uint64_t draws = 0;
    std::uint64_t vertices = 0;  ///< vertices or indices submitted
    std::uint64_t bytes_uploaded = 0;
    std::uint64_t bytes_read_back = 0;
    std::vector<std::pair<std::string, std::uint64_t>> by_name;  ///< call name and count, without zeroes, by name
};

struct CallReport {
    std::vector<CallsOfPass> passes;  ///< without those that made no call
    std::uint64_t object_creations = 0;
    std::uint64_t program_links = 0;
    [[nodiscard]] std::uint64_t draws() const;
};

/// A copy of the ledger's counts.
[[nodiscard]] CallReport call_report(const gl::CallLedger& ledger);

/// Times of this device; absent when nothing was measured.
struct Measurement {
    TimingCalibration calibration;
    std::vector<PassTimer::Summary> passes;    ///< one for each pass of the plan
    std::vector<std::vector<double>> samples;  ///< one value a frame for each pass [ms]
    PassTimer::Summary frame;                  ///< wall clock of whole frames
};

struct FrameReport {
    std::string scene;         ///< as the user named it
    std::string camera = {};   ///< of the scene; empty: one without a name, or none of its own
    std::string picture_file;  ///< where the picture went; empty: nowhere
    std::string reproduce;     ///< the command that makes this again
    std::string context;       ///< platform::Context::description()
    gl::Caps caps;
    FramePlan plan;
    Picture display;
    std::vector<std::string> notices;  ///< scene, plan and cache: each one sentence
    std::size_t texture_bytes = 0;
    CallReport prepare_calls;  ///< from an empty renderer to a prepared plan
    CallReport frame_calls;    ///< of one frame that was not timed
    gl::ProgramCache::Statistics programs;
    std::vector<ProgramUse> program_uses;  ///< every program, and why it is there
    std::optional<Measurement> measurement;
    std::optional<std::vector<CensusRow>> census;
    std::optional<Modelled> modelled;
};

/// Bytes of the targets that a pass writes, colour and depth together; a target bound without being written counts 0.
[[nodiscard]] std::size_t bytes_written(const FramePlan& plan, const Pass& pass);

}  // namespace halfframe::perf
