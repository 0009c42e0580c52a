#include "host/archive/archive.hpp"

#include "../plugins/plugin_folder.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace jet::host {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Writes zips as a villain would: any name, any kind of entry.
class Villain {
public:
    Villain() : out_(archive_write_new())
    {
        archive_write_set_format_zip(out_);
        archive_write_open(out_, &bytes_, nullptr, append, nullptr);
    }
    Villain& file(const std::string& name, const std::string& content = "x") { return entry(name, AE_IFREG, content); }
    Villain& entry(const std::string& name, unsigned type, const std::string& content = "",
                   const std::function<void(archive_entry*)>& more = {})
    {
        archive_entry* entry = archive_entry_new();
        archive_entry_set_pathname(entry, name.c_str());
        archive_entry_set_filetype(entry, type);
        archive_entry_set_perm(entry, 0644);
        archive_entry_set_size(entry, static_cast<la_int64_t>(content.size()));
        if (more) more(entry);
        archive_write_header(out_, entry);
        archive_write_data(out_, content.data(), content.size());
        archive_entry_free(entry);
        return *this;
    }
    std::string bytes()
    {
        archive_write_close(out_);
        archive_write_free(out_);
        return bytes_;
    }

private:
    static la_ssize_t append(archive*, void* target, const void* data, std::size_t size)
    {
        static_cast<std::string*>(target)->append(static_cast<const char*>(data), size);
        return static_cast<la_ssize_t>(size);
    }
    archive* out_;
    std::string bytes_;
};

class ArchiveTest : public testing::Test {
protected:
    Result<void> unpack(const std::string& bytes, const ArchiveLimits& limits = {})
    {
        std::filesystem::create_directories(inside());
        return unpackZip(bytes, inside(), "evil.jetplugin", limits);
    }
    std::string refusal(const std::string& bytes, const ArchiveLimits& limits = {})
    {
        std::filesystem::remove_all(inside());
        const auto unpacked = unpack(bytes, limits);
        return unpacked ? "it was taken" : unpacked.error().text();
    }
    std::filesystem::path inside() const { return folder_.path() / "a" / "b" / "inside"; }
    std::size_t filesOutside() const
    {
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
            if (!entry.is_directory() && !entry.path().string().starts_with(inside().string())) ++count;
        return count;
    }
    std::string read(const std::string& name) const
    {
        std::ifstream in(inside() / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    test::PluginFolder folder_;
};

TEST_F(ArchiveTest, WhatWasWrittenIsUnpackedAgain)
{
    const auto zip =
        writeZip({{"b/deep/file.txt", "two", false}, {"a.so", std::string(100'000, 'a'), true}, {"empty", "", false}});
    ASSERT_TRUE(zip);
    ASSERT_TRUE(unpack(*zip));
    EXPECT_EQ(read("b/deep/file.txt"), "two");
    EXPECT_EQ(read("a.so"), std::string(100'000, 'a'));
    EXPECT_EQ(read("empty"), "");
    const auto permissions = std::filesystem::status(inside() / "a.so").permissions();
    EXPECT_NE(permissions & std::filesystem::perms::owner_exec, std::filesystem::perms::none);
}

TEST_F(ArchiveTest, EqualFilesGiveEqualBytesWhateverTheirOrderAndTheTimeZone)
{
    const auto one = writeZip({{"a", "1", false}, {"b", "2", false}});
    ::setenv("TZ", "Asia/Tokyo", 1);
    ::tzset();
    const auto two = writeZip({{"b", "2", false}, {"a", "1", false}});
    ::unsetenv("TZ");
    ::tzset();
    ASSERT_TRUE(one && two);
    EXPECT_EQ(*one, *two);
}

TEST_F(ArchiveTest, NamesThatLeadElsewhereAreRefusedByName)
{
    const std::pair<const char*, const char*> names[] = {
        {"../evil", "leads out of the package"},
        {"a/../../evil", "leads out of the package"},
        {"/tmp/evil", "absolute path"},
        {"./evil", "leads out of the package"},
        {"a//evil", "empty part"},
        {"..\\evil", "leads out of the package"},
        {"C:/evil", "':'"},
        {"evil\nname", "printable ASCII"},
        {"\xC3\xA9vil", "printable ASCII"},
        {"evil.", "ends with a dot"},
        {"a /evil", "space"},
    };
    for (const auto& [name, reason] : names) {
        const std::string text = refusal(Villain().file("plugin.json").file(name).bytes());
        EXPECT_THAT(text, StartsWith("evil.jetplugin: error: this package is refused: '")) << name;
        EXPECT_THAT(text, HasSubstr(reason)) << name;
    }
    EXPECT_EQ(filesOutside(), 0u);
}

TEST_F(ArchiveTest, NamesInUtf8AreTakenWhereAskedForInAnyLocale)
{
    ArchiveLimits limits;
    limits.unicodeNames = true;
    const std::string name = "Größe/日本.png";
    const auto zip = writeZip({{name, "x", false}});
    ASSERT_TRUE(zip) << zip.error().text();
    EXPECT_TRUE(checkZip(*zip, "a.jetz", limits));
    EXPECT_FALSE(checkZip(*zip, "a.jetplugin"));
    ASSERT_TRUE(unpack(*zip, limits));
    EXPECT_EQ(read(name), "x");
    EXPECT_THAT(refusal(Villain().file("evil\nname").bytes(), limits), HasSubstr("control character"));
    EXPECT_THAT(refusal(Villain().file("\xC0\xAF\xED\xA0\x80").bytes(), limits), HasSubstr("not UTF-8"));
    EXPECT_THAT(refusal(Villain().file("../Größe").bytes(), limits), HasSubstr("leads out"));
}

TEST_F(ArchiveTest, WhatCouldNotBeUnpackedIsNotWritten)
{
    for (const char* name : {"", "../a", "a\nb", "/a"})
        EXPECT_THAT(writeZip({{name, "x", false}}).error().text(), HasSubstr("cannot be packed")) << name;
}

TEST_F(ArchiveTest, LinksAndDevicesAreRefusedByName)
{
    const auto symlink =
        Villain()
            .entry("door", AE_IFLNK, "", [](archive_entry* e) { archive_entry_set_symlink(e, "/tmp"); })
            .file("door/evil")
            .bytes();
    EXPECT_THAT(refusal(symlink), HasSubstr("'door': it is a symbolic link"));
    for (const auto& [type, name] : {std::pair(AE_IFCHR, "null"), std::pair(AE_IFBLK, "disk")}) {
        // libarchive's writer refuses some kinds itself: patch the mode in the directory at the end.
        std::string bytes = Villain().file(name).bytes();
        const std::size_t central = bytes.find("PK\x01\x02");
        ASSERT_NE(central, std::string::npos);
        const unsigned mode = static_cast<unsigned>(type) | 0644U;
        bytes[central + 40] = static_cast<char>(mode & 0xff);
        bytes[central + 41] = static_cast<char>(mode >> 8);
        EXPECT_THAT(refusal(bytes), HasSubstr("'" + std::string(name) + "': it is neither a file nor a folder"));
    }
    EXPECT_EQ(filesOutside(), 0u);
}

TEST_F(ArchiveTest, NamesThatMeetInOneFileAreRefused)
{
    EXPECT_THAT(refusal(Villain().file("a").file("a").bytes()), HasSubstr("'a': it is in the package twice"));
    EXPECT_THAT(refusal(Villain().file("plugin.json").file("Plugin.JSON").bytes()),
                HasSubstr("differs from 'plugin.json' in upper and lower case only"));
    EXPECT_THAT(refusal(Villain().file("icons/a").file("Icons/b").bytes()), HasSubstr("in upper and lower case only"));
    EXPECT_THAT(refusal(Villain().file("a").file("a/b").bytes()), HasSubstr("is a file and a folder at once"));
}

TEST_F(ArchiveTest, AFolderEntryMayStandBesideItsFiles)
{
    EXPECT_TRUE(unpack(Villain().entry("icons/", AE_IFDIR).file("icons/a").file("icons/b").bytes()));
    EXPECT_EQ(read("icons/b"), "x");
}

TEST_F(ArchiveTest, BombsAreRefusedBeforeTheyFillTheDisk)
{
    const std::string zeros(8U << 20, '\0');
    EXPECT_THAT(refusal(Villain().file("zeros", zeros).bytes()),
                HasSubstr("'zeros': the package unpacks to more than 200 times its size"));

    ArchiveLimits small;
    small.unpackedBytes = 1U << 20;
    EXPECT_THAT(refusal(Villain().file("zeros", zeros).bytes(), small), HasSubstr("unpacks to more than 1 MB"));

    Villain many;
    for (int i = 0; i < 200; ++i) many.file("f" + std::to_string(i));
    ArchiveLimits few;
    few.files = 100;
    EXPECT_THAT(refusal(many.bytes(), few), HasSubstr("'f100': the package has more than 100 files"));

    EXPECT_THAT(refusal(Villain().file(std::string(5000, 'n')).bytes()), HasSubstr("longer than 1024 characters"));
    EXPECT_THAT(refusal(Villain().file(std::string(300, 'n')).bytes()), HasSubstr("longer than 200 characters"));
    std::string deep;
    for (int i = 0; i < 50; ++i) deep += "d/";
    EXPECT_THAT(refusal(Villain().file(deep + "f").bytes()), HasSubstr("folders deep"));

    ArchiveLimits tiny;
    tiny.packageBytes = 10;
    EXPECT_THAT(refusal(Villain().file("a").bytes(), tiny), HasSubstr("larger than"));
}

// The size an entry claims is not believed: what comes out is counted.
TEST_F(ArchiveTest, ASizeThatIsALieHelpsNoBomb)
{
    std::string bytes = Villain().file("zeros", std::string(8U << 20, '\0')).bytes();
    const std::size_t central = bytes.find("PK\x01\x02");
    ASSERT_NE(central, std::string::npos);
    for (std::size_t i = 24; i < 28; ++i) bytes[central + i] = i == 24 ? 1 : 0;  // "one byte"
    ASSERT_FALSE(unpack(bytes));
    std::uintmax_t written = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(inside()))
        if (entry.is_regular_file()) written += entry.file_size();
    EXPECT_LT(written, 5U << 20);
}

// Truncations and flips all over: an error or the same files, never more.
TEST_F(ArchiveTest, DamagedPackagesAreRefusedOrHarmless)
{
    const auto whole =
        writeZip({{"plugin.json", std::string(300, 'j'), false}, {"lib.so", std::string(500, 's'), true}});
    ASSERT_TRUE(whole);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < whole->size(); i += 3) {
        std::string flipped = *whole;
        flipped[i] = static_cast<char>(flipped[i] ^ 0x41);
        for (const std::string& bytes : {whole->substr(0, i), flipped}) {
            refused += !unpack(bytes);
            std::filesystem::remove_all(inside());
        }
    }
    EXPECT_GT(refused, whole->size() / 3);
    EXPECT_EQ(filesOutside(), 0u);
}

TEST_F(ArchiveTest, WhatIsNoZipIsToldSo)
{
    EXPECT_THAT(refusal("this is no zip"), HasSubstr("this is no package, or it is damaged"));
    EXPECT_THAT(refusal(""), HasSubstr("this is no package, or it is damaged"));
}

TEST_F(ArchiveTest, OneFileIsReadWithoutTheOthers)
{
    const auto zip = writeZip({{"plugin.json", "{}", false}, {"big", std::string(10'000, 'b'), false}});
    ASSERT_TRUE(zip);
    const auto found = readFromZip(*zip, "plugin.json", "p.jetplugin");
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, "{}");
    const auto missing = readFromZip(*zip, "other", "p.jetplugin");
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().text(), HasSubstr("has no other at its top"));
}

}  // namespace
}  // namespace jet::host
