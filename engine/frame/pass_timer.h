// Milliseconds of each pass on this device, and the word how they were taken.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"

namespace halfframe {

enum class TimingMethod : std::uint8_t { timer_query, fence, finish };
[[nodiscard]] const char* name(TimingMethod method);

/// What the calibration saw: a heavy draw of known work by the wall clock round glFinish, and by each method.
struct TimingCalibration {
    TimingMethod method = TimingMethod::finish;
    double wall_ms = 0.0;          ///< the heavy draw between two glFinish
    double timer_query_ms = -1.0;  ///< -1: not available
    double fence_ms = -1.0;
    std::string sentence;  ///< "timer queries see 0.05 of 13.1 ms, so passes are timed with a fence"
};

/// Draws the heavy draw and decides. A method is believed when it sees at least 80 % of the wall time of the same
/// draw, three times out of three.
[[nodiscard]] TimingCalibration calibrate_timing(gl::EntryPoints& gl, const gl::Caps& caps);

/// Times passes with one method. Storage is reserved up front: timing a frame does not allocate.
class PassTimer {
public:
    PassTimer(gl::EntryPoints& gl, TimingMethod method, int pass_count, int frame_count);
    void begin_frame();
    void begin_pass(int pass);
    void end_pass(int pass);
    void end_frame();  ///< waits for the results of the frame

    struct Summary {
        double median_ms = 0.0;
        double low_ms = 0.0;   ///< 25th percentile
        double high_ms = 0.0;  ///< 75th percentile
        int frames = 0;
    };
    [[nodiscard]] Summary pass(int pass) const;
    [[nodiscard]] Summary frame() const;  ///< wall clock of whole frames
    [[nodiscard]] TimingMethod method() const { return method_; }
    [[nodiscard]] const std::vector<double>& samples(int pass) const;

private:
    gl::EntryPoints& gl_;
    TimingMethod method_;
    std::vector<std::vector<double>> samples_;
    std::vector<double> frames_;
    std::vector<gl::Query> queries_;
    std::chrono::steady_clock::time_point frame_start_{};
    std::chrono::steady_clock::time_point pass_start_{};
};

}  // namespace halfframe
