// Parsed JSON against nlohmann's tree of the same text, and the complaints about places in it.
#include "content/json_value.h"

#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "content/json_place.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

constexpr int kDeepest = 64;

void expect_equal(const JsonValue& ours, const nlohmann::json& theirs, const std::string& text) {
    ASSERT_STREQ(ours.kind_name(), theirs.type_name()) << text;
    if (theirs.is_string()) {
        EXPECT_EQ(ours.text(), theirs.get<std::string>()) << text;
    }
    if (theirs.is_boolean()) {
        EXPECT_EQ(ours.boolean(), theirs.get<bool>()) << text;
    }
    if (theirs.is_number()) {
        EXPECT_EQ(ours.number(), theirs.get<double>()) << text;
        EXPECT_EQ(ours.number_text(), theirs.dump()) << text;
        EXPECT_EQ(ours.kind() == JsonValue::Kind::whole, theirs.is_number_unsigned()) << text;
    }
    if (theirs.is_array()) {
        ASSERT_EQ(ours.elements().size(), theirs.size()) << text;
        for (std::size_t i = 0; i < theirs.size(); ++i) expect_equal(ours.elements()[i], theirs[i], text);
    }
    if (theirs.is_object()) {
        ASSERT_EQ(ours.members().size(), theirs.size()) << text;
        auto member = ours.members().begin();
        for (const auto& [key, value] : theirs.items()) {
            EXPECT_EQ(*member->key, key) << text;
            ASSERT_NE(ours.find(key), nullptr) << text;
            expect_equal(*ours.find(key), value, text);
            EXPECT_EQ(ours.find(key + "x") != nullptr, theirs.contains(key + "x")) << text;
            ++member;
        }
    }
}

void expect_as_nlohmann(const std::string& text) {
    JsonDocument document;
    const auto fault = document.parse(text, kDeepest);
    ASSERT_FALSE(fault) << text << ": " << fault->what;
    expect_equal(document.root(), nlohmann::json::parse(text), text);
}

TEST(JsonValue, IsWhatNlohmannReads) {
    for (const char* text : {"null",
                             "true",
                             "0",
                             "-0",
                             "-7",
                             "18446744073709551615",
                             "18446744073709551616",
                             "-9223372036854775808",
                             "3.0",
                             "1e-300",
                             "0.1",
                             "\"\"",
                             R"("a \u00e9 \n \ud83d\ude00")",
                             "[]",
                             "{}",
                             "[[],{},[[]]]",
                             R"({"":{"":1}})",
                             R"({"a":1,"b":2,"a":3})",
                             R"({"b":1,"a":2,"abcdefghi":3,"abcdefghj":4,"abcdefgh":5})",
                             R"({"a\u0000":1,"a":2,"a\u0000b":3})",
                             "  [1 ,\t2\n]  ",
                             "\xEF\xBB\xBF[1]"})
        expect_as_nlohmann(text);
}

TEST(JsonValue, FindsKeysOfSmallAndLargeObjects) {
    for (const int count : {15, 16, 17, 18, 1000}) {
        std::string text = "{";
        for (int i = 0; i < count; ++i)  // in no order, some a second time
            text += fmt::format("{}\"key {}\":{}", i == 0 ? "" : ",", i * 7919 % (count - count / 8), i);
        expect_as_nlohmann(text + "}");
    }
}

std::string random_text(std::mt19937& random, int depth) {
    const auto below = [&](unsigned most) { return static_cast<unsigned>(random() % most); };
    const unsigned kind = below(depth > 5 ? 5 : 7);
    if (kind == 0) return "null";
    if (kind == 1) return below(2) == 0 ? "true" : "false";
    if (kind == 2) return std::to_string(static_cast<int>(random()));
    if (kind == 3) return fmt::format("{}", static_cast<double>(random()) / 7.0);
    if (kind == 4) return fmt::format("\"{}\"", std::string(below(40), 'x'));
    std::string text(1, kind == 5 ? '[' : '{');
    const unsigned count = below(kind == 5 ? 6 : 25);
    for (unsigned i = 0; i < count; ++i) {
        text += i == 0 ? "" : ",";
        if (kind == 6) text += fmt::format("\"{}{}\":", std::string(below(12), 'k'), below(30));
        text += random_text(random, depth + 1);
    }
    return text + (kind == 5 ? ']' : '}');
}

TEST(JsonValue, IsWhatNlohmannReadsOfRandomTexts) {
    std::mt19937 random(20131107);
    for (int i = 0; i < 300; ++i) expect_as_nlohmann(random_text(random, 0));
}

TEST(JsonValue, NamesTheByteThatNlohmannNames) {
    for (const std::string text : {"", "[1,", "{\"a\":}", "[1]]", "\"\x01\"", "nul", "[\"\xFF\"]", "{\"a\" 1}", "01"}) {
        JsonDocument document;
        const auto fault = document.parse(text, kDeepest);
        ASSERT_TRUE(fault) << text;
        EXPECT_STREQ(document.root().kind_name(), "null") << text;
        try {
            const nlohmann::json parsed = nlohmann::json::parse(text);
            ADD_FAILURE() << text << " is JSON for nlohmann: " << parsed;
        } catch (const nlohmann::json::parse_error& error) {
            EXPECT_EQ(fault->byte, error.byte) << text;
        }
    }
    JsonDocument document;
    const auto fault = document.parse("[1e999]", kDeepest);
    ASSERT_TRUE(fault);
    EXPECT_FALSE(fault->byte) << "a number out of range is JSON all the same";
}

TEST(JsonValue, StopsWhereBracketsNestTooDeep) {
    const JsonSource source{"deep.json", "advice"};
    const std::string right = std::string(kDeepest, '[') + std::string(kDeepest, ']');
    (void)parse_json(right, source, kDeepest);
    try {
        (void)parse_json("[" + right + "]", source, kDeepest);
        ADD_FAILURE() << "65 levels were taken";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "deep.json: line 1, column 65: brackets nest deeper than 64 levels; advice");
    }
}

TEST(JsonPlace, KnowsItsPointerAfterTheDocumentHasMoved) {
    const JsonSource source{"file.json", "advice"};
    JsonDocument parsed = parse_json(R"({"a":[0,{"b":[7]}],"c":{"b":[7]}})", source);
    const JsonDocument document = std::move(parsed);
    const JsonPlace root(document, source);
    EXPECT_EQ(root.pointer(), "");
    EXPECT_EQ(root.at("a").at(1).at("b").at(std::size_t{0}).pointer(), "/a/1/b/0");
    EXPECT_EQ(root.at("c").at("b").at(std::size_t{0}).pointer(), "/c/b/0");
    EXPECT_FALSE(root.find("d"));
    try {
        (void)root.at("c").at("b").at(std::size_t{0}).text();
        ADD_FAILURE() << "a number is no text";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "file.json: /c/b/0: must be a string but is number; advice");
    }
}

}  // namespace
}  // namespace halfframe::content
