// Contact sheets: letters that fit, cells in their places, and a sheet that outlives what it draws.
#include "perf/report/contact_sheet.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "perf/report/picture_file.h"
#include "tests/perf/child_process.h"

namespace halfframe::perf {
namespace {

using test::TemporaryFolder;

constexpr Rgb kBlack = {0, 0, 0};
constexpr Rgb kWhite = {255, 255, 255};
const std::string kCommand = HALFFRAME_BINARY_DIR "/halfframe";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Picture plain(int width, int height, const Rgb& color) {
    Picture picture{.width = width, .height = height, .rgba = {}};
    picture.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    fill(picture, 0, 0, width, height, color);
    return picture;
}

Rgb pixel(const Picture& picture, int x, int y) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

/// The smallest box round all that is not black: left, top, right, bottom (inclusive); left > right where nothing is.
std::array<int, 4> ink(const Picture& picture) {
    std::array<int, 4> box{picture.width, picture.height, -1, -1};
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (pixel(picture, x, y) == kBlack) continue;
            box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
        }
    }
    return box;
}

/// Skips where no font is installed: the sheet itself then refuses with the name of a package.
class Letters : public ::testing::Test {
protected:
    void SetUp() override {
        try {
            font_ = find_font();
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
    std::filesystem::path font_;
};

TEST_F(Letters, stay_inside_their_line_and_their_width) {
    const Lettering lettering(font_, 14);
    for (const std::string text : {"Box", "jgpqy|", "MetalRoughSpheres", "\xC3\x84rger \xE2\x82\xAC"}) {
        Picture picture = plain(300, 40, kBlack);
        lettering.draw(picture, 20, 10, text, kWhite);
        const auto [left, top, right, bottom] = ink(picture);
        ASSERT_LE(left, right) << text;
        // 1 pixel: an edge that covers a part of a pixel
        EXPECT_GE(left, 19) << text;
        EXPECT_GE(top, 9) << text;
        EXPECT_LE(right, 20 + lettering.width(text)) << text;
        EXPECT_LE(bottom, 10 + lettering.height()) << text;
    }
}

TEST_F(Letters, what_is_no_utf8_shows_as_question_marks_and_the_picture_cuts_off_what_is_outside) {
    const Lettering lettering(font_, 14);
    EXPECT_EQ(lettering.width("\xFF\xC3("), lettering.width("?"
                                                            "?("));
    Picture one = plain(60, 20, kBlack);
    lettering.draw(one, 0, 0, "\xF0\x9F", kWhite);
    Picture other = plain(60, 20, kBlack);
    lettering.draw(other, 0, 0, "??", kWhite);
    EXPECT_EQ(one.rgba, other.rgba);
    Picture small = plain(4, 4, kBlack);
    lettering.draw(small, -30, -3, "a long line that begins and ends outside", kWhite);
    EXPECT_LE(ink(small)[2], 3);
}

TEST_F(Letters, shortened_names_fit_and_keep_both_ends) {
    const Lettering lettering(font_, 14);
    const std::string name = "MetalRoughSpheresNoTextures";
    EXPECT_EQ(lettering.shortened(name, 1000), name);
    for (int width = 30; width < lettering.width(name); width += 7) {
        const std::string shorter = lettering.shortened(name, width);
        EXPECT_LE(lettering.width(shorter), width) << shorter;
        EXPECT_TRUE(contains(shorter, "..")) << shorter;
        EXPECT_EQ(shorter.front(), 'M') << shorter;
    }
    EXPECT_TRUE(lettering.shortened(name, 100).ends_with("s")) << lettering.shortened(name, 100);
    EXPECT_EQ(lettering.shortened("abc", 1), "");
}

TEST_F(Letters, lines_hold_every_word_or_say_that_more_follows) {
    const Lettering lettering(font_, 14);
    const std::string text = "the file requires the extension KHR_materials_unlit, which is not supported";
    const auto all = lettering.lines(text, 120, 100);
    std::string joined;
    for (const std::string& line : all) {
        EXPECT_LE(lettering.width(line), 120) << line;
        joined += line;
    }
    std::string wished = text;
    std::erase(joined, ' ');
    std::erase(wished, ' ');
    EXPECT_EQ(joined, wished);
    ASSERT_GT(all.size(), 2u);
    const auto two = lettering.lines(text, 120, 2);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_TRUE(two.back().ends_with("..")) << two.back();
    EXPECT_LE(lettering.width(two.back()), 120) << two.back();
}

TEST(Font, a_missing_one_and_one_that_is_none_are_errors_of_input) {
    const TemporaryFolder folder;
    std::ofstream(folder / "none.ttf") << std::string(4096, 'x');
    for (const std::string& file : {(folder / "absent.ttf").string(), (folder / "none.ttf").string()}) {
        try {
            const Lettering lettering(find_font(file), 14);
            FAIL() << file;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::input);
            EXPECT_TRUE(contains(error.what(), file)) << error.what();
        }
    }
}

TEST_F(Letters, cells_lie_where_they_belong) {
    const Lettering lettering(font_, 12);
    const SheetLayout layout{.cell_width = 60, .cell_height = 40, .columns = 2};
    std::vector<SheetCell> cells(3);
    const std::array<Rgb, 3> colors{Rgb{255, 0, 0}, Rgb{0, 255, 0}, Rgb{0, 0, 255}};
    for (std::size_t i = 0; i < 3; ++i) {
        cells[i].name = "cell";
        if (i != 1) cells[i].picture = plain(60, 40, colors[i]);
    }
    cells[1].verdict = "3";
    cells[1].words = "broken";
    const Picture sheet = contact_sheet(cells, layout, lettering);
    const int step_y = 40 + 2 * 12 + 2 + 8;
    EXPECT_EQ(sheet.width, 2 * 68 + 8);
    EXPECT_EQ(sheet.height, 2 * step_y + 8);
    EXPECT_EQ(pixel(sheet, 8, 8), colors[0]);
    EXPECT_EQ(pixel(sheet, 67, 47), colors[0]);
    EXPECT_NE(pixel(sheet, 68, 47), colors[0]);
    EXPECT_EQ(pixel(sheet, 8, 8 + step_y), colors[2]);
    const Rgb grey = pixel(sheet, 135, 47);
    EXPECT_TRUE(grey[0] == grey[1] && grey[1] == grey[2]) << int(grey[0]);
    cells[1].words = "other";
    EXPECT_NE(contact_sheet(cells, layout, lettering).rgba, sheet.rgba);
}

TEST_F(Letters, a_sheet_is_about_as_wide_as_a_screen) {
    for (const std::size_t count : {1u, 2u, 7u, 30u, 100u}) {
        const SheetLayout layout;
        const int columns = sheet_columns(count, layout, 30);
        ASSERT_GE(columns, 1);
        ASSERT_LE(columns, static_cast<int>(count));
        const int rows = (static_cast<int>(count) + columns - 1) / columns;
        const double aspect = 328.0 * columns / (218.0 * rows);
        if (count > 7) {
            EXPECT_TRUE(aspect > 1.2 && aspect < 2.6) << count << ": " << aspect;
        }
    }
}

class SheetCommand : public Letters {
protected:
    void SetUp() override {
        Letters::SetUp();
        if (IsSkipped()) return;
        const test::ChildResult info = test::run_child(kCommand, {"info", "--json"});
        if (info.code == 4) GTEST_SKIP() << "no graphics context here: " << info.err;
        ASSERT_EQ(info.code, 0) << info.err;
    }
    static test::ChildResult sheet(const std::vector<std::string>& more) {
        std::vector<std::string> words{"contact-sheet", "--cache", "none"};
        const auto add = [&](const char* option, const char* value) {
            if (std::find(more.begin(), more.end(), option) == more.end()) words.insert(words.end(), {option, value});
        };
        add("--cell", "96x64");
        add("--measure", "1");
        words.insert(words.end(), more.begin(), more.end());
        return test::run_child(kCommand, words);
    }
};

TEST_F(SheetCommand, draws_built_in_scenes_and_is_quiet_in_a_pipe) {
    const TemporaryFolder folder;
    const std::string file = (folder / "sheet.png").string();
    const test::ChildResult result = sheet({"furnace", "empty", "-o", file, "--tier", "low", "--columns", "2"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "furnace") && contains(result.out, "empty")) << result.out;
    const Picture picture = read_png(file);
    EXPECT_EQ(picture.width, 2 * (96 + 8) + 8);
    // The furnace's spheres against the flat background of the empty scene.
    EXPECT_NE(pixel(picture, 8 + 48, 8 + 32), pixel(picture, 112 + 48, 8 + 32));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"sheet.png"});
}

TEST_F(SheetCommand, searches_folders_and_a_broken_file_leaves_a_grey_cell_and_exit_code_3) {
    const TemporaryFolder folder;
    const TemporaryFolder out;
    std::filesystem::create_directories(folder / "below");
    const std::string points =
        R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
            "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1}]})";
    std::ofstream(folder / "below/sound.GLTF") << points;
    std::ofstream(folder / "broken.gltf") << "{";
    std::ofstream(folder / "unrelated.txt") << "nothing";
    const std::string file = (out / "sheet.png").string();
    const test::ChildResult result = sheet({folder.path().string(), "-o", file});
    EXPECT_EQ(result.code, 3) << result.err;
    EXPECT_TRUE(contains(result.err, "broken.gltf")) << result.err;
    EXPECT_TRUE(contains(result.out, "sound") && contains(result.out, "broken")) << result.out;
    EXPECT_FALSE(contains(result.out, "unrelated")) << result.out;
    // below/ comes before broken.gltf; the second cell is the grey one.
    EXPECT_EQ(pixel(read_png(file), 112 + 94, 8 + 62), (Rgb{96, 96, 96}));
}

TEST_F(SheetCommand, a_scene_that_crashes_or_never_ends_leaves_the_others_drawn) {
    const TemporaryFolder folder;
    const std::string file = (folder / "sheet.png").string();
    // Limits that the second scene alone runs into: 1000 frames of 1280x720 take more than 10 s of processor time.
    const std::string line = "ulimit -t 5; exec '" + kCommand + "' contact-sheet empty test_room -o '" + file +
                             "' --cell 1280x720 --measure 1000 --cache none";
    const test::ChildResult killed = test::run_child("/bin/sh", {"-c", line});
    EXPECT_EQ(killed.code, 3) << killed.err;
    EXPECT_TRUE(contains(killed.out, "signal")) << killed.out;
    EXPECT_EQ(read_png(file).width % (1280 + 8), 8);
    const test::ChildResult late =
        sheet({"test_room", "-o", file, "--limit", "1", "--cell", "1280x720", "--measure", "1000"});
    EXPECT_EQ(late.code, 3) << late.err;
    EXPECT_TRUE(contains(late.out, "timeout")) << late.out;
}

TEST_F(SheetCommand, says_what_is_wrong_with_its_words) {
    const TemporaryFolder folder;
    const std::string file = (folder / "sheet.png").string();
    const std::vector<std::tuple<std::vector<std::string>, int, std::string>> cases{
        {{folder.path().string(), "-o", file}, 3, "no .gltf or .glb"},
        {{"furnace", "-o", (folder / "sheet.jpg").string()}, 2, ".png"},
        {{"furnace", "-o", file, "--tier", "loww"}, 2, "did you mean 'low'"},
        {{"furnace", "-o", file, "--cell", "9000x1"}, 2, "--cell 9000x1"},
        {{"furnace", "empty", "-o", file, "--cell", "8192x8192", "--columns", "2"}, 2, "smaller --cell"},
        {{"furnace", "-o", file, "--font", (folder / "no.ttf").string()}, 3, "no such font"},
        {{"furnace", "-o", file, "--device", "no_such"}, 2, "no_such"},
    };
    for (const auto& [words, code, expected] : cases) {
        const test::ChildResult result = sheet(words);
        EXPECT_EQ(result.code, code) << expected << "\n" << result.err;
        EXPECT_TRUE(contains(result.err, expected)) << expected << "\n" << result.err;
    }
}

}  // namespace
}  // namespace halfframe::perf
