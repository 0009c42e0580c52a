#include "support/tool_fixture.hpp"

#include <jet/format.hpp>

#include <QImage>

#include <filesystem>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using jet::Box;
using jet::Item;

class ImageToolTest : public jet::test::ToolFixture {
protected:
    ImageToolTest() : ToolFixture{"org.jet.tool.image"}
    {
        fs::create_directories(folder / "project");
        QImage image(40, 20, QImage::Format_RGB32);
        image.fill(Qt::red);
        image.save(QString::fromStdString((folder / "cat.png").string()));
        scene().setAssetFolder((folder / "project").string());
        tool("image-tool").option("file", (folder / "cat.png").string());
    }
    ~ImageToolTest() override { fs::remove_all(folder); }

    const Item& image()
    {
        const Item* found = nullptr;
        scene().root().walk([&](const Item& item) {
            if (item.is<jet::ImageItem>()) found = &item;
        });
        return *found;
    }
    fs::path folder = fs::temp_directory_path() / ("jet-image-" + std::to_string(::getpid()));
};

TEST_F(ImageToolTest, AClickPlacesThePictureInItsOwnSizeAndCopiesTheFileIntoTheProject)
{
    tool("image-tool").click({100, 100});
    EXPECT_EQ(image().bounds(), Box({80, 90}, {120, 110}));
    EXPECT_EQ(image().property("file")->as<std::string>(), "assets/cat.png");
    EXPECT_EQ(image().name(), "cat");
    EXPECT_EQ(jet::readFile(folder / "project/assets/cat.png").orThrow(), jet::readFile(folder / "cat.png").orThrow());
    EXPECT_EQ(undoSteps(), 1u);
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(ImageToolTest, ADragFitsItInAndShiftFillsTheBox)
{
    tool("image-tool").drag({0, 0}, {100, 100});
    EXPECT_EQ(image().bounds(), Box({0, 25}, {100, 75})) << "its sides stay in proportion";
    undo();
    tool("image-tool").hold({.shift = true}).drag({0, 0}, {100, 100});
    EXPECT_EQ(image().bounds(), Box({0, 0}, {100, 100}));
}

TEST_F(ImageToolTest, TheSamePictureTwiceIsOneFile)
{
    tool("image-tool").click({100, 100}).click({200, 100});
    const auto files = std::distance(fs::directory_iterator(folder / "project/assets"), {});
    EXPECT_EQ(files, 1);
}

TEST_F(ImageToolTest, WithoutAProjectFolderItRefersToTheFileWhereItIs)
{
    scene().setAssetFolder({});
    tool("image-tool").click({100, 100});
    EXPECT_EQ(image().property("file")->as<std::string>(), (folder / "cat.png").string());
}

TEST_F(ImageToolTest, WhatIsNoPictureIsRefusedWithAReason)
{
    jet::writeFileAtomically(folder / "bad.png", std::string_view("no picture")).orThrow();
    tool("image-tool").option("file", (folder / "bad.png").string()).click({100, 100});
    EXPECT_EQ(scene().hash(), emptySceneHash());
    EXPECT_NE(host().status.find("no picture"), std::string::npos) << host().status;
    EXPECT_FALSE(fs::exists(folder / "project/assets"));
}

}  // namespace
