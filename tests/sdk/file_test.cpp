#include <jet/format.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace jet {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FileTest : public testing::Test {
protected:
    FileTest()
    {
        std::string name = (fs::temp_directory_path() / "jet-file-XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~FileTest() override { fs::remove_all(folder); }
    std::string content(const fs::path& file) { return readFile(file).orThrow(); }
    std::size_t count() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    fs::path folder;
};

TEST_F(FileTest, WhatIsWrittenIsReadBack)
{
    const std::string all = std::string("\0\xff\r\n", 4) + std::string(200'000, 'x');
    writeFileAtomically(folder / "a", all).orThrow();
    EXPECT_EQ(content(folder / "a"), all);
    writeFileAtomically(folder / "a", "short").orThrow();
    EXPECT_EQ(content(folder / "a"), "short");
    EXPECT_EQ(count(), 1u) << "no temporary file stays";
}

TEST_F(FileTest, PermissionsAreKept)
{
    writeFileAtomically(folder / "a", "1").orThrow();
    ::chmod((folder / "a").c_str(), 0640);
    writeFileAtomically(folder / "a", "2").orThrow();
    EXPECT_EQ(fs::status(folder / "a").permissions(), static_cast<fs::perms>(0640));
}

TEST_F(FileTest, ASymbolicLinkIsFollowed)
{
    writeFileAtomically(folder / "target", "1").orThrow();
    fs::create_symlink("target", folder / "link");
    writeFileAtomically(folder / "link", "2").orThrow();
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(content(folder / "target"), "2");
}

TEST_F(FileTest, AReadOnlyFileIsLeftAlone)
{
    writeFileAtomically(folder / "a", "1").orThrow();
    fs::permissions(folder / "a", fs::perms::owner_read);
    EXPECT_THAT(writeFileAtomically(folder / "a", "2").error().text(),
                HasSubstr("a: error: cannot be written: Permission denied"));
    EXPECT_EQ(content(folder / "a"), "1");
}

// Renaming a file over a device would replace the device.
TEST_F(FileTest, ADeviceIsWrittenIntoAndStaysADevice)
{
    if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    EXPECT_THAT(writeFileAtomically("/dev/full", "x").error().text(),
                HasSubstr("No space left on device; free some space"));
    EXPECT_TRUE(writeFileAtomically("/dev/null", "x"));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, APipeIsWrittenInto)
{
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::FILE* reader = ::popen(("cat '" + pipe.string() + "'").c_str(), "r");
    writeFileAtomically(pipe, "through").orThrow();
    char buffer[20] = {};
    ASSERT_NE(std::fgets(buffer, sizeof buffer, reader), nullptr);
    ::pclose(reader);
    EXPECT_STREQ(buffer, "through");
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(FileTest, FoldersAndMissingPlacesAreNamed)
{
    EXPECT_THAT(writeFileAtomically(folder, "x").error().text(), HasSubstr("is a folder; name a file to write"));
    EXPECT_THAT(writeFileAtomically(folder / "no" / "a", "x").error().text(), HasSubstr("its folder exists"));
    EXPECT_THAT(readFile(folder).error().text(), HasSubstr("is a folder, not a file"));
    EXPECT_THAT(readFile(folder / "no").error().text(),
                HasSubstr("cannot be opened: No such file or directory; check the name"));
}

TEST_F(FileTest, ExtensionsAreLowerCaseWithoutTheDot)
{
    EXPECT_EQ(extensionOf("a/b.SVG"), "svg");
    EXPECT_EQ(extensionOf("a.b/c"), "");
    EXPECT_EQ(extensionOf("a.tar.Gz"), "gz");
    EXPECT_EQ(extensionOf(".hidden"), "");
}

}  // namespace
}  // namespace jet
