// Drawings by others, kept beside the source tree where they are at hand: none may hang, crash or come out empty.
#include "svg_fixture.hpp"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <test_paths.hpp>

namespace jet::test {

namespace {

const std::filesystem::path kData = std::filesystem::path(JET_SOURCE_DIR) / "../shared/data/svg";

}  // namespace

class SvgFilesTest : public SvgTest {
protected:
    /// Seconds of processor time the import of a file took.
    double import(const std::filesystem::path& file, Result<void>& result)
    {
        const Result<std::string> text = readFile(file);
        if (!text) ADD_FAILURE() << text.error().text();
        const std::clock_t start = std::clock();
        if (text) result = importText(*text);
        return double(std::clock() - start) / CLOCKS_PER_SEC;
    }

    static std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder, std::string_view prefix = {})
    {
        std::vector<std::filesystem::path> files;
        if (!std::filesystem::exists(folder)) return files;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (entry.path().extension() == ".svg" && name.starts_with(prefix)) files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        return files;
    }
};

TEST_F(SvgFilesTest, PathologicalFilesTakeLessThanTwoSeconds)
{
    const auto files = filesIn(kData / "pathological");
    if (files.empty()) GTEST_SKIP() << "The pathological drawings are not beside this source tree.";
    for (const auto& file : files) {
        SCOPED_TRACE(file.filename().string());
        Result<void> result;
        notes_.clear();
        EXPECT_LT(import(file, result), 2);
        EXPECT_TRUE(!result || !notes_.empty()) << "neither an error nor a note";
        EXPECT_TRUE(result || result.error().where.line > 0);
    }
}

TEST_F(SvgFilesTest, RealDrawingsHaveItems)
{
    const auto files = filesIn(kData / "real");
    if (files.empty()) GTEST_SKIP() << "The real drawings are not beside this source tree.";
    for (const auto& file : files) {
        SCOPED_TRACE(file.filename().string());
        const std::size_t before = scene_.items().itemCount();
        Result<void> result;
        import(file, result);
        EXPECT_TRUE(result) << result.error().text();
        EXPECT_GT(scene_.items().itemCount(), before);
    }
}

}  // namespace jet::test
