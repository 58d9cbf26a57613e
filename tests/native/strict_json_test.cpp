// JSON that a lenient reader would misunderstand in silence.
#include <gtest/gtest.h>

#include "base/strict_json.h"
#include "base/text.h"
#include "refusal_of.h"

namespace natator {
namespace {

std::string refusal(const std::string& text) {
    return test::refusal_of([&] { parse_json(text, "here"); });
}

TEST(StrictJsonTest, ReadsWhatIsValid) {
    EXPECT_EQ(parse_json(R"({"a":[1,2,{"a":3}],"b":{"a":null}})", "x").dump(), R"({"a":[1,2,{"a":3}],"b":{"a":null}})");
}

TEST(StrictJsonTest, RefusesAKeyGivenTwice) {
    EXPECT_EQ(refusal(R"({"a":1,"b":{"a":2},"a":3})"), "here: key \"a\" is given twice; must be given once");
}

TEST(StrictJsonTest, RefusesWhatIsNotJson) {
    for (const char* text : {"", "{", "nan", "[NaN]", "[1e999]", "[1,]", "{} {}", "'a'", "[\"\xff\"]", "// x\n1"}) {
        const std::string message = refusal(text);
        EXPECT_EQ(message.find("here: not valid JSON: "), 0u) << text << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
    }
}

/// The library takes it for the end, whatever follows.
TEST(StrictJsonTest, RefusesAByte0BehindTheValue) {
    EXPECT_EQ(refusal(std::string("{}\0{\"a\":1}", 11)), "here: not valid JSON: byte 3 is 0; must be text");
}

TEST(StrictJsonTest, RefusesDeepNesting) {
    EXPECT_EQ(refusal(std::string(32, '[') + std::string(32, ']')), "");
    EXPECT_NE(refusal(std::string(33, '[') + std::string(33, ']')).find("nested deeper than 32"), std::string::npos);
    EXPECT_NE(refusal(std::string(1'000'000, '[')).find("nested deeper than 32"), std::string::npos);
}

/// The library quotes what it has read last, which may be the whole document.
TEST(StrictJsonTest, SaysWhatIsWrongShortly) {
    const std::string message = refusal("[\"" + std::string(1'000'000, 'x'));
    EXPECT_EQ(message.find("here: not valid JSON: parse error at line 1"), 0u) << message.substr(0, 200);
    EXPECT_LT(message.size(), 400u);
    std::string umlauts = "[\"";
    for (int k = 0; k < 1000; ++k) umlauts += "\u00e4";  // two bytes each: the cut must not leave one
    const std::string cut = refusal(umlauts);
    EXPECT_NO_THROW(nlohmann::json(cut).dump()) << cut;
    const std::string longer = refusal("x" + umlauts), longest = refusal("  " + umlauts);
    EXPECT_NO_THROW(nlohmann::json(longer).dump() + nlohmann::json(longest).dump());
}

TEST(StrictJsonTest, ShowsNumbersToThePlaceWhereTheyMeanSomething) {
    EXPECT_EQ(computed_text(18 * 0.075), "1.35");
    EXPECT_EQ(figure_text(0.687997), "0.688");
    EXPECT_EQ(figure_text(4950.18), "4950");
    EXPECT_EQ(figure_text(-6.25e-9), "-6.25e-09");
    EXPECT_EQ(figure_text(-0.0), "0");
}

TEST(StrictJsonTest, ShowsValuesOnOneShortLine) {
    EXPECT_EQ(shown("a\nb"), R"("a\nb")");
    EXPECT_EQ(shown(nlohmann::json::array({1, 2.5})), "[1,2.5]");
    EXPECT_LE(shown(std::string(1000, 'x')).size(), 70u);
    EXPECT_GE(quoted(std::string(300, 'x')).size(), 302u);
    EXPECT_EQ(quoted("\xff"), "\"\\ufffd\"");
    EXPECT_EQ(quoted("m\u00e9/\u6d77/\U0001f41f/a\\\"b"), "\"m\u00e9/\u6d77/\U0001f41f/a\\\\\\\"b\"");
    EXPECT_EQ(quoted("\\u00e9 \\ud83d\\udc1f"), R"("\\u00e9 \\ud83d\\udc1f")");  // six characters each, not one
    EXPECT_EQ(quoted("\x1b[31m\x7f\t\u0085\u00ad\u202e\u200b\u2028\ufeff\U000e0041"),
              R"("\u001b[31m\u007f\t\u0085\u00ad\u202e\u200b\u2028\ufeff\udb40\udc41")");
    EXPECT_EQ(quoted("\xc3\xa9\xc3 \xed\xa0\x80 \xc0\xaf"), "\"\u00e9\\ufffd \\ufffd\\ufffd\\ufffd \\ufffd\\ufffd\"");
    for (std::size_t more = 0; more < 5; ++more) {  // no cut within a character
        std::string fishes(more, 'x');
        for (int i = 0; i < 200; ++i) fishes += "\U0001f41f";
        EXPECT_EQ(nlohmann::json(natator::quoted(fishes)).dump().find("\\ufffd"), std::string::npos) << more;
    }
    EXPECT_EQ(as_one_line("a \"m\u00e9\" \\ b\nc\rd\x1b\xff" + std::string(1000, 'x')),
              "a \"m\u00e9\" \\ b c d\\u001b\\ufffd" + std::string(1000, 'x'));
}

}  // namespace
}  // namespace natator
