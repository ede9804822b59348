// halfframe info: what this machine and driver really do, found by asking and by drawing.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/pass_timer.h"
#include "perf/cli/command.h"
#include "perf/cli/graphics_device.h"
#include "perf/cli/terminal.h"
#include "perf/measure/precision_probe.h"
#include "perf/report/json_report.h"
#include "perf/report/text_report.h"
#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

struct TierAnswer {
    Tier tier = Tier::low;
    bool runs = false;
    std::string why;
};

/// Plans a small scene at each tier: a tier runs when the plan is made and breaks no rule.
std::vector<TierAnswer> ask_tiers(const gl::Caps& caps) {
    const Scene scene = content::open_scene("test_room");
    View view;
    view.width = 64;
    view.height = 64;
    std::vector<TierAnswer> answers;
    for (int index = 0; index < kTierCount; ++index) {
        TierAnswer answer{.tier = static_cast<Tier>(index), .runs = false, .why = {}};
        try {
            Wishes wishes;
            wishes.tier = answer.tier;
            wishes.reads_light = true;  // what the device has for it
            const FramePlan plan = plan_frame(scene, view, wishes, caps, all_effects());
            const auto broken = broken_rule(plan, caps);
            answer.runs = !broken;
            answer.why = broken ? *broken
                                : fmt::format("{} storage, {} arithmetic", gl::name(plan.storage),
                                              halfframe::name(plan.arithmetic));
        } catch (const Error& error) {
            answer.why = error.what();
        }
        answers.push_back(std::move(answer));
    }
    return answers;
}

/// All that the command shows.
struct Findings {
    std::string context;
    gl::Caps caps;
    std::vector<TierAnswer> tiers;
    perf::PrecisionProbe precision;
    TimingCalibration timing;
};

std::string yes_no(bool value) { return value ? "yes" : "no"; }

std::string limits_text(const gl::Caps& caps) {
    perf::TextTable table({{"limit"}, {"", perf::Align::right}});
    const auto add = [&](const char* limit, int value) { table.add_row({limit, std::to_string(value)}); };
    add("texture size [pixels]", caps.max_texture_size);
    add("cube map size [pixels]", caps.max_cube_map_size);
    add("renderbuffer size [pixels]", caps.max_renderbuffer_size);
    add("vertex attributes", caps.max_vertex_attributes);
    add("vertex uniform vectors", caps.max_vertex_uniform_vectors);
    add("fragment uniform vectors", caps.max_fragment_uniform_vectors);
    add("varying vectors", caps.max_varying_vectors);
    add("fragment samplers", caps.max_fragment_samplers);
    add("vertex samplers", caps.max_vertex_samplers);
    add("combined samplers", caps.max_combined_samplers);
    add("draw buffers", caps.max_draw_buffers);
    add("samples", caps.max_samples);
    add("3D texture size [pixels]", caps.max_texture_3d_size);
    return table.text();
}

std::string abilities_text(const gl::Caps& caps) {
    perf::TextTable table({{"ability"}, {""}});
    const auto add = [&](const char* ability, bool value) { table.add_row({ability, yes_no(value)}); };
    add("explicit LOD in fragments", caps.explicit_lod);
    add("derivatives", caps.derivatives);
    add("32-bit indices", caps.index_uint);
    add("vertex array objects", caps.vertex_array_objects);
    add("sized formats", caps.sized_formats);
    add("sRGB textures", caps.srgb_textures);
    add("depth textures", caps.depth_texture);
    add("full non-power-of-two textures", caps.npot_textures);
    add("program binaries", caps.program_binary);
    add("fences", caps.fence_sync);
    add("timer queries", caps.timer_query);
    add("exact fragment counts", caps.samples_passed);
    add("debug labels", caps.debug_labels);
    add("blending of 32-bit floats", caps.float_blend);
    add("anisotropic filtering", caps.anisotropy);
    add("discarding framebuffers", caps.discard_framebuffer);
    return table.text();
}

std::string precision_text(const gl::PrecisionFormat& format) {
    return fmt::format("2^-{} to 2^{}, {} fraction bits", format.range_min, format.range_max, format.precision);
}

void print_findings(const Findings& found) {
    const gl::Caps& caps = found.caps;
    print(fmt::format("context: {}\nrenderer: {}\nvendor: {}\nversion: {}\n", found.context, caps.renderer, caps.vendor,
                      caps.version));
    print(fmt::format("device: {} (rules of ES {}.{}{}{}){}\n\n", caps.device, caps.es_version / 10,
                      caps.es_version % 10, caps.desktop ? ", a desktop context running ES text" : "",
                      caps.core_profile ? ", core profile" : "",
                      caps.software ? ", a software driver: times are the CPU's" : ""));

    perf::TextTable tiers({{"tier"}, {"runs"}, {"how, or why not"}});
    for (const TierAnswer& answer : found.tiers) {
        tiers.add_row({halfframe::name(answer.tier), yes_no(answer.runs), answer.why});
    }
    print(tiers.text() + "\n");

    print("arithmetic, by drawing: " + found.precision.sentence + "\n");
    print(fmt::format("  mediump in fragments, as stated: {}\n  highp in fragments, as stated: {}\n\n",
                      precision_text(caps.fragment_mediump),
                      caps.fragment_highp ? precision_text(caps.fragment_highp_format) : "none"));

    perf::TextTable formats({{"target format"}, {"renders, by drawing"}, {"B/pixel", perf::Align::right}});
    for (int index = 0; index < gl::kPixelFormatCount; ++index) {
        const auto format = static_cast<gl::PixelFormat>(index);
        if (format == gl::PixelFormat::srgb8_alpha8) {
            continue;  // for textures alone: never drawn to
        }
        formats.add_row({gl::name(format), yes_no(caps.renders[static_cast<std::size_t>(index)]),
                         std::to_string(gl::bytes_per_pixel(format))});
    }
    print(formats.text() + "\n");
    print(fmt::format("timing: {}; {}\n\n", halfframe::name(found.timing.method), found.timing.sentence));
    print(limits_text(caps) + "\n" + abilities_text(caps) + "\n");
    print(perf::wrapped(fmt::format("extensions ({}): {}", caps.extensions.size(), fmt::join(caps.extensions, " ")),
                        118, 4) +
          "\n");
}

nlohmann::ordered_json probe_json(const perf::ArithmeticProbe& probe) {
    const char* overflow = probe.overflow == perf::Overflow::to_infinity ? "to_infinity"
                           : probe.overflow == perf::Overflow::clamps    ? "clamps"
                                                                         : "none";
    return {{"drawn", probe.drawn},
            {"is_half", probe.is_half()},
            {"overflow", overflow},
            {"loses_small_steps", probe.loses_small_steps},
            {"keeps_subnormals", probe.keeps_subnormals}};
}

void print_findings_json(const Findings& found) {
    nlohmann::ordered_json tiers = nlohmann::ordered_json::array();
    for (const TierAnswer& answer : found.tiers) {
        tiers.push_back({{"tier", halfframe::name(answer.tier)}, {"runs", answer.runs}, {"why", answer.why}});
    }
    const auto milliseconds = [](double ms) {
        return ms < 0.0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(ms);
    };
    print_json({{"context", found.context},
                {"caps", perf::caps_json(found.caps)},
                {"tiers", tiers},
                {"arithmetic",
                 {{"sentence", found.precision.sentence},
                  {"mediump", probe_json(found.precision.mediump)},
                  {"highp", probe_json(found.precision.highp)}}},
                {"timing",
                 {{"method", halfframe::name(found.timing.method)},
                  {"sentence", found.timing.sentence},
                  {"wall_ms", found.timing.wall_ms},
                  {"timer_query_ms", milliseconds(found.timing.timer_query_ms)},
                  {"fence_ms", milliseconds(found.timing.fence_ms)}}}});
}

class InfoCommand : public Command {
public:
    explicit InfoCommand(CLI::App& app) {
        CLI::App& command = *app.add_subcommand(
            "info",
            "Shows the driver, what it can do, which tiers run, what half precision really is, and how time is taken");
        add_device_options(command, options_);
        command.add_flag("--json", json_, "Standard output is one JSON value; everything else goes to standard error");
        command.footer(kExitCodes);
    }

    [[nodiscard]] std::string name() const override { return "info"; }

    int run() override {
        GraphicsDevice device(options_);
        Findings found;
        found.context = device.context().description();
        found.caps = device.caps();
        found.tiers = ask_tiers(device.caps());
        stop_if_interrupted();
        found.precision = perf::probe_precision(device.gl(), device.caps());
        stop_if_interrupted();
        found.timing = calibrate_timing(device.gl(), device.caps());
        if (json_) {
            print_findings_json(found);
        } else {
            print_findings(found);
        }
        return 0;
    }

private:
    DeviceOptions options_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_info_command(CLI::App& app) { return std::make_unique<InfoCommand>(app); }

}  // namespace halfframe::cli
