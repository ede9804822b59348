// Tables, numbers and HTML as text.
#include <gtest/gtest.h>

#include "engine/error.h"
#include "perf/report/html_page.h"
#include "perf/report/text_table.h"

namespace halfframe::perf {
namespace {

TEST(TextTable, aligns_columns_and_leaves_no_trailing_blanks) {
    TextTable table({{"name"}, {"ms", Align::right}, {"why"}});
    table.add_row({"sky", "1.25", ""});
    table.add_rule();
    table.add_row({"tone_map", "12.5", "asked"});
    EXPECT_EQ(table.text(),
              "name        ms  why\n"
              "---------------------\n"
              "sky       1.25\n"
              "---------------------\n"
              "tone_map  12.5  asked\n");
}

TEST(TextTable, a_row_of_another_width_is_our_mistake) {
    TextTable table({{"a"}, {"b"}});
    EXPECT_THROW(table.add_row({"1"}), Mistake);
}

TEST(Numbers, have_the_digits_that_mean_something) {
    EXPECT_EQ(ms_text(0.0421), "0.042");
    EXPECT_EQ(ms_text(1.7), "1.70");
    EXPECT_EQ(ms_text(33.3), "33.3");
    EXPECT_EQ(ms_text(412.4), "412");
    EXPECT_EQ(bytes_text(12), "12 B");
    EXPECT_EQ(bytes_text(3584), "3.5 KiB");
    EXPECT_EQ(bytes_text(std::size_t{1280} * 720 * 4), "3.52 MiB");
}

TEST(Wrapping, breaks_at_blanks_and_indents) {
    EXPECT_EQ(wrapped("one two three four", 9, 2), "one two\n  three\n  four");
    EXPECT_EQ(wrapped("unbreakable", 4, 2), "unbreakable");
}

TEST(Html, escapes_what_would_be_markup) {
    EXPECT_EQ(html_escaped("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
}

TEST(Html, base64_of_rfc_4648_section_10) {
    const auto encoded = [](std::string_view text) {
        return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
    };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace halfframe::perf
