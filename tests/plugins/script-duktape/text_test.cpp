#include <text.hpp>

#include <gtest/gtest.h>

namespace jet::duktape {

TEST(ScriptTextTest, CharactersBeyondTheBasicPlaneBecomeSurrogatesAndBack)
{
    EXPECT_EQ(cesu8FromUtf8("a😀"), "a\xED\xA0\xBD\xED\xB8\x80");
    EXPECT_EQ(utf8FromCesu8("a\xED\xA0\xBD\xED\xB8\x80"), "a😀");
    for (const char* text : {"", "plain", "zażółć gęślą jaźń", "漢字", "😀😺", "\U0010FFFF"})
        EXPECT_EQ(utf8FromCesu8(cesu8FromUtf8(text)), text);
}

TEST(ScriptTextTest, WhatIsNoTextBecomesReplacementCharacters)
{
    EXPECT_EQ(utf8FromCesu8("\xED\xA0\xBD"), "\uFFFD");    // a lone high surrogate
    EXPECT_EQ(utf8FromCesu8("\xED\xB8\x80x"), "\uFFFDx");  // a lone low one
    EXPECT_EQ(cesu8FromUtf8("\xFFitem"), "\uFFFDitem");    // would be a hidden key of Duktape
    EXPECT_EQ(cesu8FromUtf8("\xC3"), "\uFFFD");            // cut short
    EXPECT_EQ(cesu8FromUtf8("\xC3("), "\uFFFD(");
    EXPECT_EQ(cesu8FromUtf8("\xF5\x80\x80\x80").substr(0, 3), "\uFFFD");
}

TEST(ScriptTextTest, CutsAreBetweenCharacters)
{
    EXPECT_EQ(shortened("żółw", 7), "żółw");
    EXPECT_EQ(shortened("żółw", 3), "ż… (5 bytes more)");
}

}  // namespace jet::duktape
