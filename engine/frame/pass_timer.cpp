// Calibrates and times.
#include "engine/frame/pass_timer.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/gl/program.h"

namespace halfframe {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kHeavySize = 384;    // at most; pixels a side: about 10 ms on two idle llvmpipe threads, under 1 ms on a phone
constexpr double kBelieved = 0.8;  // of the wall time of the same draw, in the worst of three: less is something else
constexpr GLuint64 kFenceWaitNs = 2'000'000'000;
constexpr GLenum kTimeElapsed = 0x88BF;  // GL_TIME_ELAPSED, EXT_disjoint_timer_query
constexpr GLenum kQueryResult = 0x8866;  // GL_QUERY_RESULT

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void wait_for_fence(gl::EntryPoints& gl) {
    GLsync fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kFenceWaitNs);
    gl.DeleteSync(fence);
}

double quantile(std::vector<double> sorted, double q) {
    if (sorted.empty()) return 0.0;
    std::ranges::sort(sorted);
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const auto high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (sorted[high] - sorted[low]) * (at - static_cast<double>(low));
}

PassTimer::Summary summary(const std::vector<double>& samples) {
    return {quantile(samples, 0.5), quantile(samples, 0.25), quantile(samples, 0.75), static_cast<int>(samples.size())};
}

/// The heavy draw with everything it needs, gone when it goes out of scope.
class HeavyDraw {
public:
    HeavyDraw(gl::EntryPoints& gl, const gl::Caps& caps) : gl_(gl), programs_(gl, caps, {}) {
        gl::ProgramDescription description;
        description.name = "calibration";
        description.vertex = "calibration/heavy_draw.vert";
        description.fragment = "calibration/heavy_draw.frag";
        description.dialect = gl::Dialect::es100;
        description.arithmetic = caps.fragment_highp ? gl::Arithmetic::full : gl::Arithmetic::half;
        description.fragment_highp = caps.fragment_highp;
        description.attributes = {{"position", 0}};
        program_ = &programs_.get(description);
        seed_ = program_->uniform("seed");
        target_ = gl::create<gl::Kind::texture>(gl);
        gl.BindTexture(GL_TEXTURE_2D, target_.name());
        const int side = std::min(kHeavySize, caps.max_texture_size);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        framebuffer_ = gl::create<gl::Kind::framebuffer>(gl);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_.name(), 0);
        if (caps.vertex_array_objects || caps.core_profile) {
            array_ = gl::create<gl::Kind::vertex_array>(gl);
            gl.BindVertexArray(array_.name());
        }
        constexpr std::array<float, 6> kTriangle = {-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};
        triangle_ = gl::create<gl::Kind::buffer>(gl);
        gl.BindBuffer(GL_ARRAY_BUFFER, triangle_.name());
        gl.BufferData(GL_ARRAY_BUFFER, sizeof(kTriangle), kTriangle.data(), GL_STATIC_DRAW);
        gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        gl.EnableVertexAttribArray(0);
        gl.Viewport(0, 0, side, side);
        for (const GLenum capability : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE}) gl.Disable(capability);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    ~HeavyDraw() {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
        gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
        gl_.UseProgram(0);
        if (array_) gl_.BindVertexArray(0);
    }
    HeavyDraw(const HeavyDraw&) = delete;
    HeavyDraw& operator=(const HeavyDraw&) = delete;

    void draw() {
        constexpr std::array<float, 4> kSeed = {0.37f, 0.001f, 0.0f, 0.0f};
        gl_.UseProgram(program_->name());
        gl_.Uniform4fv(seed_, 1, kSeed.data());
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    }

private:
    gl::EntryPoints& gl_;
    gl::ProgramCache programs_;
    gl::Program* program_ = nullptr;
    int seed_ = -1;
    gl::Texture target_;
    gl::Framebuffer framebuffer_;
    gl::VertexArray array_;
    gl::Buffer triangle_;
};

/// One heavy draw as a method saw it and as the wall clock round glFinish saw it, [ms].
struct Seen {
    double method_ms = 0.0;
    double wall_ms = 0.0;
    [[nodiscard]] double share() const { return wall_ms > 0.0 ? method_ms / wall_ms : 0.0; }
};

/// The draw of three of which the method saw the smallest share. Both clocks run over the same draw, so that a busy
/// machine slows both.
template <typename Work>
Seen worst_of_three(gl::EntryPoints& gl, Work&& method_ms) {
    Seen worst{1.0, 0.0};
    for (int i = 0; i < 3; ++i) {
        gl.Finish();
        const auto start = Clock::now();
        Seen seen;
        seen.method_ms = method_ms();
        gl.Finish();
        seen.wall_ms = ms_since(start);
        if (worst.wall_ms == 0.0 || seen.share() < worst.share()) worst = seen;
    }
    return worst;
}

}  // namespace

const char* name(TimingMethod method) {
    switch (method) {
        case TimingMethod::timer_query: return "timer query";
        case TimingMethod::fence: return "fence";
        case TimingMethod::finish: return "glFinish";
    }
    throw Mistake("a timing method without a name");
}

TimingCalibration calibrate_timing(gl::EntryPoints& gl, const gl::Caps& caps) {
    const gl::PassScope scope(gl, "calibration");
    TimingCalibration seen;
    HeavyDraw heavy(gl, caps);
    heavy.draw();  // compiles
    gl.Finish();
    Seen query_seen, fence_seen;
    if (caps.timer_query) {
        const gl::Query query = gl::create<gl::Kind::query>(gl);
        query_seen = worst_of_three(gl, [&] {
            gl.BeginQuery(kTimeElapsed, query.name());
            heavy.draw();
            gl.EndQuery(kTimeElapsed);
            GLuint64 ns = 0;
            gl.GetQueryObjectui64v(query.name(), kQueryResult, &ns);  // waits
            return static_cast<double>(ns) * 1e-6;
        });
        seen.timer_query_ms = query_seen.method_ms;
    }
    if (caps.fence_sync) {
        fence_seen = worst_of_three(gl, [&] {
            const auto start = Clock::now();
            heavy.draw();
            wait_for_fence(gl);
            return ms_since(start);
        });
        seen.fence_ms = fence_seen.method_ms;
    }
    seen.wall_ms = caps.timer_query ? query_seen.wall_ms : fence_seen.wall_ms;
    if (query_seen.share() >= kBelieved) {
        seen.method = TimingMethod::timer_query;
        seen.sentence =
            fmt::format("timer queries see {:.1f} of {:.1f} ms of a heavy draw: passes are timed with timer queries",
                        query_seen.method_ms, query_seen.wall_ms);
        return seen;
    }
    const std::string query_part = caps.timer_query
                                       ? fmt::format("timer queries see only {:.1f} of {:.1f} ms of a heavy draw",
                                                     query_seen.method_ms, query_seen.wall_ms)
                                       : std::string("there are no timer queries");
    if (fence_seen.share() >= kBelieved) {
        seen.method = TimingMethod::fence;
        seen.sentence = fmt::format("{}, a fence {:.1f} of {:.1f} ms: each pass is timed to a fence", query_part,
                                    fence_seen.method_ms, fence_seen.wall_ms);
    } else {
        seen.method = TimingMethod::finish;
        seen.sentence = fmt::format("{} and no fence can be believed: each pass is timed to glFinish", query_part);
    }
    return seen;
}

PassTimer::PassTimer(gl::EntryPoints& gl, TimingMethod method, int pass_count, int frame_count)
    : gl_(gl), method_(method) {
    samples_.resize(static_cast<std::size_t>(pass_count));
    for (auto& samples : samples_) samples.reserve(static_cast<std::size_t>(frame_count));
    frames_.reserve(static_cast<std::size_t>(frame_count));
    if (method == TimingMethod::timer_query) {
        for (int i = 0; i < pass_count; ++i) queries_.push_back(gl::create<gl::Kind::query>(gl));
    }
}

void PassTimer::begin_frame() {
    gl_.Finish();
    frame_start_ = Clock::now();
}

void PassTimer::begin_pass(int pass) {
    if (method_ == TimingMethod::timer_query)
        gl_.BeginQuery(kTimeElapsed, queries_[static_cast<std::size_t>(pass)].name());
    pass_start_ = Clock::now();
}

void PassTimer::end_pass(int pass) {
    switch (method_) {
        case TimingMethod::timer_query: gl_.EndQuery(kTimeElapsed); return;  // read at the end of the frame
        case TimingMethod::fence: wait_for_fence(gl_); break;
        case TimingMethod::finish: gl_.Finish(); break;
    }
    samples_[static_cast<std::size_t>(pass)].push_back(ms_since(pass_start_));
}

void PassTimer::end_frame() {
    gl_.Finish();
    frames_.push_back(ms_since(frame_start_));
    for (std::size_t i = 0; i < queries_.size(); ++i) {
        GLuint64 ns = 0;
        gl_.GetQueryObjectui64v(queries_[i].name(), kQueryResult, &ns);
        samples_[i].push_back(static_cast<double>(ns) * 1e-6);
    }
}

PassTimer::Summary PassTimer::pass(int pass) const { return summary(samples(pass)); }

PassTimer::Summary PassTimer::frame() const { return summary(frames_); }

const std::vector<double>& PassTimer::samples(int pass) const { return samples_[static_cast<std::size_t>(pass)]; }

}  // namespace halfframe
