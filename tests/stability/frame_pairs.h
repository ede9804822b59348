// A context with a bench that draws pairs of frames, and what a failure leaves behind.
#pragma once

#include <optional>

#include "perf/accuracy/frame_accuracy.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {

class FramePairs : public harness::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped()) return;
        if (!caps().renders[static_cast<std::size_t>(gl::PixelFormat::rgba32f)])
            GTEST_SKIP() << "the census needs RGBA32F targets, and " << caps().renderer << " does not render them";
        bench_.emplace(gl(), caps());
    }
    void TearDown() override {
        bench_.reset();
        GlFixture::TearDown();
    }

    accuracy::FrameBench& bench() { return *bench_; }

    /// Every pair of the kind at every tier and in both arithmetics.
    void expect_stable(const std::string& kind) {
        int measured = 0;
        for (const accuracy::FrameCase& pair : accuracy::frame_cases()) {
            if (pair.kind != kind) continue;
            expect_stable(pair, {Tier::low, Tier::console, Tier::reference});
            ++measured;
        }
        EXPECT_GE(measured, 1) << "no pair is of the kind " << kind;
    }

    void expect_stable(const accuracy::FrameCase& pair, std::initializer_list<Tier> tiers) {
        for (const Tier tier : tiers) {
            for (const Arithmetic arithmetic : {Arithmetic::full, Arithmetic::half}) {
                const accuracy::FrameAccuracy found = bench().measure(pair, tier, arithmetic);
                for (const std::string& violation : found.violations) ADD_FAILURE() << violation << kept(found);
            }
        }
    }

private:
    /// Writes both pictures and what differs; says where.
    static std::string kept(const accuracy::FrameAccuracy& found) {
        std::string name = found.kind + "_" + found.change;
        for (char& letter : name) {
            if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
        }
        const std::filesystem::path base = harness::image_folder() / (name + "_" + halfframe::name(found.tier) + "_" +
                                                                      halfframe::name(found.arithmetic));
        harness::write_png(base.string() + ".expected.png", found.plain);
        harness::write_png(base.string() + ".actual.png", found.changed);
        harness::write_png(base.string() + ".difference.png", harness::difference_picture(found.changed, found.plain));
        return "; see " + base.string() + ".*.png";
    }

    std::optional<accuracy::FrameBench> bench_;
};

}  // namespace halfframe::tests
