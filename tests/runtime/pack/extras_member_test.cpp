// Tests that members of extras are found in any text.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/extras_member.h"

#include <gtest/gtest.h>
#include <random>
#include <string>

namespace hearth::test
{

using pack::findMember;

TEST(FindMember, returnsTheTextOfAValue)
{
    constexpr std::string_view kText =
        R"({ "a" : 1.50 , "b":{"a":2,"deep":[{"c":"]}"}]},"c":"say \"a\":3, \"{","d":[1,2] , "":true,"e":null })";
    EXPECT_EQ(findMember(kText, "a"), "1.50");
    EXPECT_EQ(findMember(kText, "b"), R"({"a":2,"deep":[{"c":"]}"}]})");
    EXPECT_EQ(findMember(kText, "c"), R"("say \"a\":3, \"{")");
    EXPECT_EQ(findMember(kText, "d"), "[1,2]");
    EXPECT_EQ(findMember(kText, ""), "true");
    EXPECT_EQ(findMember(kText, "e"), "null");
    EXPECT_EQ(findMember(kText, "deep"), "") << "members of members are not its own";
    EXPECT_EQ(findMember(kText, "f"), "");
    EXPECT_EQ(findMember(R"({"T\u00fcr":1})", R"(T\u00fcr)"), "1") << "escapes stay";
}

TEST(FindMember, findsNothingInWhatIsNoObject)
{
    for (const std::string_view text :
         {"", "{", "{}", "[\"a\",1]", "\"a\"", "1", "null", "{\"a\"", "{\"a\":", "{\"a\":}", "{a:1}",
          "{\"a\" 1}", "{\"a\":\"x", "{\"a\":[1}", "{\"a", "{\"a\\"})
        EXPECT_EQ(findMember(text, "a"), "") << text;
}

TEST(FindMember, staysWithinBrokenText)
{
    constexpr std::string_view kCharacters = "{}[]\",:\\a1 ";
    std::mt19937 random(5);
    for (int i = 0; i < 20000; ++i)
    {
        std::string text = "{";
        for (uint32_t length = random() % 24; length > 0; --length)
            text += kCharacters[random() % kCharacters.size()];
        const std::string_view value = findMember(text, "a");
        EXPECT_TRUE(value.empty() ||
                    (value.data() > text.data() && value.data() + value.size() < text.data() + text.size()));
    }
}

} // namespace hearth::test
