#include "window_fixture.hpp"

#include <jet/format.hpp>

#include <QApplication>
#include <QClipboard>
#include <QDragEnterEvent>
#include <QImage>
#include <QMimeData>
#include <QTest>

namespace jet::test {

namespace fs = std::filesystem;

class PicturesTest : public WindowFixture {
protected:
    PicturesTest() : WindowFixture({"org.jet.tool.selection", "org.jet.tool.text", "org.jet.io-svg"})
    {
        QImage image(40, 20, QImage::Format_RGB32);
        image.fill(Qt::red);
        image.save(QString::fromStdString(folder("cat.png").string()));
    }
    ~PicturesTest() override { QApplication::clipboard()->clear(); }

    void save() { ASSERT_TRUE(window().projects().saveAs(folder("game"))); }
    void drop(const char* file, const QPoint& at)
    {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(folder(file).string()))});
        QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &event);
    }
    std::vector<const Item*> images()
    {
        std::vector<const Item*> found;
        scene().root().walk([&](const Item& item) {
            if (item.is<ImageItem>()) found.push_back(&item);
        });
        return found;
    }
    std::string fileOf(const Item& item) { return item.property("file")->as<std::string>(); }
};

TEST_F(PicturesTest, ADroppedPictureLiesWhereItWasDroppedAndIsAFileOfTheProject)
{
    save();
    drop("cat.png", {200, 100});
    ASSERT_EQ(images().size(), 1u);
    EXPECT_EQ(images()[0]->bounds(), Box({180, 90}, {220, 110}));
    EXPECT_EQ(fileOf(*images()[0]), "assets/cat.png");
    EXPECT_TRUE(fs::exists(folder("game") / "assets/cat.png"));
    trigger("edit.undo");
    EXPECT_TRUE(images().empty());
}

TEST_F(PicturesTest, APictureThatCannotBeReadIsRefused)
{
    writeFileAtomically(folder("bad.png"), std::string_view("no picture")).orThrow();
    drop("bad.png", {200, 100});
    EXPECT_TRUE(images().empty());
    EXPECT_FALSE(isEnabled("edit.undo")) << "no step was made";
    EXPECT_NE(window().messages().text().indexOf("no picture that can be shown"), -1);
}

TEST_F(PicturesTest, PastedPixelsBecomeAPngOfTheProject)
{
    QImage image(30, 30, QImage::Format_RGB32);
    image.fill(Qt::blue);
    QApplication::clipboard()->setImage(image);
    trigger("edit.paste");
    EXPECT_TRUE(images().empty()) << "an unsaved project has no folder for it";
    EXPECT_NE(window().messages().text().indexOf("save the project"), -1);
    save();
    trigger("edit.paste");
    ASSERT_EQ(images().size(), 1u);
    EXPECT_EQ(fileOf(*images()[0]), "assets/Pasted.png");
    EXPECT_EQ(images()[0]->bounds().width(), 30);
    EXPECT_TRUE(images()[0]->bounds().center().isApprox(Vec2(view().sceneCentre().x(), view().sceneCentre().y())));
}

TEST_F(PicturesTest, PicturesInAnImportedDrawingBecomeFilesOfTheProject)
{
    save();
    const std::string bytes = readFile(folder("cat.png")).orThrow();
    const std::string base64 = QByteArray::fromStdString(bytes).toBase64().toStdString();
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='99' height='99'><g>"
                            "<image width='40' height='20' href='data:image/png;base64," +
                            base64 + "'/><image width='40' height='20' href='cat.png'/></g></svg>";
    writeFileAtomically(folder("drawing.svg"), svg).orThrow();
    ASSERT_TRUE(window().formats().importFile(folder("drawing.svg")));
    ASSERT_EQ(images().size(), 2u);
    EXPECT_EQ(fileOf(*images()[0]), "assets/picture.png");
    EXPECT_EQ(fileOf(*images()[1]), "assets/picture.png") << "the same picture is one file";
    EXPECT_EQ(readFile(folder("game") / "assets/picture.png").orThrow(), bytes);
    trigger("edit.undo");
    EXPECT_TRUE(images().empty());
}

TEST_F(PicturesTest, TextIsTypedIntoTheSceneWithItsSpacesAndLettersThatAreShortcuts)
{
    window().setActiveTool("text-tool");
    QTest::mouseClick(&view(), Qt::LeftButton, {}, {200, 100});
    QTest::keyClicks(&view(), "my M v");
    QTest::keyClick(&view(), Qt::Key_Backspace);
    EXPECT_EQ(window().activeTool(), "text-tool") << "no letter switched the tool";
    const Item* text = nullptr;
    scene().root().walk([&](const Item& item) {
        if (item.is<TextItem>()) text = &item;
    });
    ASSERT_NE(text, nullptr);
    EXPECT_EQ(text->property("text")->as<std::string>(), "my M ");
    trigger("edit.undo");
    EXPECT_EQ(scene().items().itemCount(), 1u) << "one step, while it was being typed";
}

}  // namespace jet::test
