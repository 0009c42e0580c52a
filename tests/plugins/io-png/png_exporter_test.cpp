// PNG export: which part of a scene is shown at which size, and that the pixels are the scene's.
#include "support/test_catalog.hpp"

#include <jet/format.hpp>
#include <jet/scene.hpp>

#include <gtest/gtest.h>

#include <QImage>

namespace jet::test {

class PngExporterTest : public testing::Test {
protected:
    void addRectangle(const Box& box, Color color)
    {
        auto edit = scene_.items().begin("Add");
        const Item& shape = edit.add<ShapeItem>(scene_.root(), Path::rectangle(box));
        edit.addEffect(shape, "polygon-face", {{"color", color}});
        edit.commit();
    }
    void setPage(double width, double height)
    {
        auto edit = scene_.items().begin("Page");
        edit.setScene("page-width", width);
        edit.setScene("page-height", height);
        edit.commit();
    }

    Result<std::vector<std::byte>> write(const ExportRequest& request)
    {
        return catalog_.exporter("png")->write(request);
    }
    ExportRequest request() { return {scene_, nullptr, {}, 0, 0, {}, "picture.png", notes_, {}}; }
    QImage picture(const ExportRequest& request)
    {
        const auto bytes = write(request);
        if (!bytes) {
            ADD_FAILURE() << bytes.error().text();
            return {};
        }
        return QImage::fromData(reinterpret_cast<const uchar*>(bytes->data()), int(bytes->size()), "PNG");
    }

    TestCatalog catalog_{"org.jet.io-png", "org.jet.effect.polygon-face", "org.jet.effect.stroke"};
    EventsCenter events_;
    Scene scene_{"Scene", events_, catalog_};
    std::vector<FormatNote> notes_;
    const Color red_{255, 0, 0, 255}, blue_{0, 0, 255, 255};
};

TEST_F(PngExporterTest, APageIsShownPixelForUnit)
{
    setPage(40, 30);
    addRectangle(Box({10, 10}, {20, 20}), red_);
    const QImage image = picture(request());
    ASSERT_EQ(image.size(), QSize(40, 30));
    EXPECT_EQ(image.pixelColor(10, 10), QColor(Qt::red));
    EXPECT_EQ(image.pixelColor(19, 19), QColor(Qt::red));
    EXPECT_EQ(image.pixelColor(9, 9).alpha(), 0);
    EXPECT_EQ(image.pixelColor(20, 20).alpha(), 0);
}

TEST_F(PngExporterTest, LaterItemsCoverEarlierOnes)
{
    setPage(20, 20);
    addRectangle(Box({0, 0}, {20, 20}), red_);
    addRectangle(Box({10, 0}, {20, 20}), blue_);
    const QImage image = picture(request());
    EXPECT_EQ(image.pixelColor(5, 5), QColor(Qt::red));
    EXPECT_EQ(image.pixelColor(15, 5), QColor(Qt::blue));
}

TEST_F(PngExporterTest, WithoutAPageTheItemsAreShownWithAMargin)
{
    addRectangle(Box({-50, 100}, {50, 160}), red_);
    const QImage image = picture(request());
    EXPECT_EQ(image.size(), QSize(116, 76));
    EXPECT_EQ(image.pixelColor(4, 4).alpha(), 0);
    EXPECT_EQ(image.pixelColor(58, 38), QColor(Qt::red));
}

struct SizeCase {
    int width, height;
    QSize expected;
    Box covered;  // pixels the 40 x 20 page takes
};

class PngSizeTest : public PngExporterTest, public testing::WithParamInterface<SizeCase> {};

TEST_P(PngSizeTest, ScalesToFitInTheMiddle)
{
    setPage(40, 20);
    addRectangle(Box({0, 0}, {40, 20}), red_);
    ExportRequest r = request();
    r.width = GetParam().width;
    r.height = GetParam().height;
    const QImage image = picture(r);
    ASSERT_EQ(image.size(), GetParam().expected);
    const Box box = GetParam().covered;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            EXPECT_EQ(image.pixelColor(x, y).alpha() == 255, box.contains(Vec2(x + 0.5, y + 0.5))) << x << " " << y;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, PngSizeTest,
                         testing::Values(SizeCase{80, 0, {80, 40}, Box({0, 0}, {80, 40})},
                                         SizeCase{0, 10, {20, 10}, Box({0, 0}, {20, 10})},
                                         SizeCase{80, 80, {80, 80}, Box({0, 20}, {80, 60})},
                                         SizeCase{100, 20, {100, 20}, Box({30, 0}, {70, 20})}));

TEST_F(PngExporterTest, AViewIsShownFromItsAnchor)
{
    addRectangle(Box({10, 10}, {20, 20}), red_);
    ExportRequest r = request();
    r.view = View{{10, 10}, 3};
    r.width = 60, r.height = 40;
    const QImage image = picture(r);
    ASSERT_EQ(image.size(), QSize(60, 40));
    EXPECT_EQ(image.pixelColor(0, 0), QColor(Qt::red));
    EXPECT_EQ(image.pixelColor(29, 29), QColor(Qt::red));
    EXPECT_EQ(image.pixelColor(30, 30).alpha(), 0);
}

TEST_F(PngExporterTest, TheBackgroundIsTheOneAskedFor)
{
    setPage(10, 10);
    ExportRequest r = request();
    r.background = Color{1, 2, 3, 255};
    EXPECT_EQ(picture(r).pixelColor(5, 5), QColor(1, 2, 3));
    r.background.reset();
    EXPECT_EQ(picture(r).pixelColor(5, 5).alpha(), 0);
}

TEST_F(PngExporterTest, HiddenItemsAreNeitherShownNorCounted)
{
    addRectangle(Box({0, 0}, {10, 10}), red_);
    addRectangle(Box({0, 0}, {1000, 10}), blue_);
    auto edit = scene_.items().begin("Hide");
    edit.set(*scene_.root().children()[1], "visible", false);
    edit.commit();
    const QImage image = picture(request());
    EXPECT_EQ(image.size(), QSize(26, 26));
    EXPECT_EQ(image.pixelColor(13, 13), QColor(Qt::red));
}

TEST_F(PngExporterTest, AnEmptySceneIsStillAPicture) { EXPECT_FALSE(picture(request()).isNull()); }

TEST_F(PngExporterTest, APoseReplacesTheDrawnPath)
{
    setPage(40, 40);
    addRectangle(Box({0, 0}, {10, 10}), red_);
    struct Moved final : PoseSource {
        Path path = Path::rectangle(Box({20, 20}, {30, 30}));
        const Path* pose(const Item& item) const override { return item.path().isEmpty() ? nullptr : &path; }
    } moved;
    ExportRequest r = request();
    r.poses = &moved;
    const QImage image = picture(r);
    EXPECT_EQ(image.pixelColor(5, 5).alpha(), 0);
    EXPECT_EQ(image.pixelColor(25, 25), QColor(Qt::red));
}

TEST_F(PngExporterTest, EqualScenesGiveEqualBytes)
{
    addRectangle(Box({0, 0}, {33, 10}), red_);
    EXPECT_EQ(*write(request()), *write(request()));
}

TEST_F(PngExporterTest, AbsurdSizesAreRefusedWithTheReason)
{
    addRectangle(Box({0, 0}, {10, 10}), red_);
    for (const auto& [width, height] :
         {std::pair(40'000, 10), std::pair(10, 40'000), std::pair(32'000, 32'000), std::pair(-1, 5)}) {
        ExportRequest r = request();
        r.width = width, r.height = height;
        const auto bytes = write(r);
        ASSERT_FALSE(bytes) << width << " x " << height;
        EXPECT_NE(bytes.error().message.find("pixels"), std::string::npos);
    }
}

TEST_F(PngExporterTest, AHugeSceneWithoutASizeIsRefused)
{
    addRectangle(Box({0, 0}, {1e8, 10}), red_);
    const auto bytes = write(request());
    ASSERT_FALSE(bytes);
    EXPECT_NE(bytes.error().message.find("smaller width or height"), std::string::npos) << bytes.error().message;
}

TEST_F(PngExporterTest, CancellingIsAnError)
{
    setPage(10, 10);
    ExportRequest r = request();
    r.progress.report = [](double) { return false; };
    EXPECT_FALSE(write(r));
}

}  // namespace jet::test
