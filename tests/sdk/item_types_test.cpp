// Sound, image and text items: how they are painted. Springs and torques are tested where they act, in
// simulation_test.cpp.
#include "scene_fakes.hpp"
#include "support/recording_painter.hpp"

#include <jet/scene_painter.hpp>

namespace jet {
namespace {

/// Cannot read any picture.
class BlindPainter final : public Painter {
public:
    explicit BlindPainter(test::RecordingPainter& to) : to_(to) {}
    void save() override { to_.save(); }
    void restore() override { to_.restore(); }
    void transform(const Affine& m) override { to_.transform(m); }
    void clip(const Path& path, FillRule rule) override { to_.clip(path, rule); }
    void opacity(double factor) override { to_.opacity(factor); }
    void fill(const Path& path, const Brush& brush, FillRule rule) override { to_.fill(path, brush, rule); }
    void stroke(const Path& path, const Pen& pen) override { to_.stroke(path, pen); }
    void text(const Vec2& at, std::string_view utf8, const TextStyle& style) override { to_.text(at, utf8, style); }
    void image(const Box& where, const Image& image) override { to_.image(where, image); }
    bool picture(const Affine&, std::string_view) override { return false; }
    double pixelsPerUnit() const override { return 1; }

private:
    test::RecordingPainter& to_;
};

class ItemTypesTest : public test::SceneFixture {
protected:
    const Item& add(std::string_view type, Path path, std::vector<std::pair<std::string, Value>> values = {})
    {
        auto edit = items().begin("Add");
        const Item& item = edit.add(type, layer(), std::move(path));
        for (auto& [id, value] : values) edit.set(item, id, value);
        edit.commit();
        return item;
    }
    test::RecordingPainter painted(PaintPurpose purpose)
    {
        test::RecordingPainter painter;
        paintScene(scene, nullptr, purpose, Box({-1e6, -1e6}, {1e6, 1e6}), painter);
        EXPECT_TRUE(painter.balanced());
        return painter;
    }
    static Path frame(double width, double height) { return Path::rectangle(Box({0, 0}, {width, height})); }
};

TEST_F(ItemTypesTest, ATextIsItsLinesOneBelowTheOther)
{
    add(TextItem::type, frame(200, 100), {{"text", "one\n\nthree"}, {"size", 20.0}, {"font", "DejaVu Sans"}});
    const auto texts = painted(PaintPurpose::Export).texts();
    ASSERT_EQ(texts.size(), 2u) << "an empty line is only space";
    EXPECT_EQ(texts[0].text, "one");
    EXPECT_EQ(texts[1].text, "three");
    EXPECT_DOUBLE_EQ(texts[1].at.y() - texts[0].at.y(), 2 * 1.2 * 20);
    EXPECT_EQ(texts[0].style.family, "DejaVu Sans");
    EXPECT_EQ(texts[0].style.align, TextAlign::Left);
}

TEST_F(ItemTypesTest, AlignmentIsWithinTheFrame)
{
    for (const auto& [align, x] : {std::pair("left", 0.0), std::pair("center", 100.0), std::pair("right", 200.0)}) {
        const Item& item = add(TextItem::type, frame(200, 100), {{"align", align}});
        const auto texts = painted(PaintPurpose::Export).texts();
        EXPECT_DOUBLE_EQ(texts.back().at.x(), x) << align;
        auto edit = items().begin("Remove");
        edit.remove(item);
        edit.commit();
    }
}

TEST_F(ItemTypesTest, ATextTurnsWithItsFrame)
{
    const Item& item = add(TextItem::type, frame(200, 100), {{"align", "right"}});
    const Vec2 before = painted(PaintPurpose::Export).texts().front().at;
    const Affine turn = Affine::rotation(0.7, {3, 4});
    auto edit = items().begin("Turn");
    edit.transform(item, turn);
    edit.commit();
    const Vec2 after = painted(PaintPurpose::Export).texts().front().at;
    EXPECT_NEAR((after - turn * before).norm(), 0, 1e-9);
}

TEST_F(ItemTypesTest, TheFrameOfAPathIsItsParallelogramElseItsBounds)
{
    EXPECT_EQ(Vec2(frameOf(frame(20, 10)) * Vec2(1, 1)), Vec2(20, 10));
    const std::array skewed{Vec2(0, 0), Vec2(10, 2), Vec2(13, 9), Vec2(3, 7)};
    EXPECT_EQ(Vec2(frameOf(Path::polygon(skewed)) * Vec2(1, 1)), Vec2(13, 9));
    EXPECT_EQ(Vec2(frameOf(Path::line({2, 3}, {8, 5})) * Vec2(1, 1)), Vec2(8, 5));
    EXPECT_FALSE(frameOf(Path()).isInvertible());
}

TEST_F(ItemTypesTest, SoundsShowWhileEditingOnly)
{
    add(SoundItem::type, frame(20, 20));
    EXPECT_FALSE(painted(PaintPurpose::Edit).drawn().empty());
    EXPECT_TRUE(painted(PaintPurpose::Play).drawn().empty());
    EXPECT_TRUE(painted(PaintPurpose::Export).drawn().empty());
}

TEST_F(ItemTypesTest, AnImageOnASurfaceWithoutPicturesIsItsOutline)
{
    add(ImageItem::type, frame(20, 10), {{"file", "a.png"}, {"opacity", 0.5}});
    const auto strokes = painted(PaintPurpose::Export).strokes();
    ASSERT_EQ(strokes.size(), 1u);
    EXPECT_EQ(strokes[0].path.bounds(), Box({0, 0}, {20, 10}));
    EXPECT_EQ(strokes[0].opacity, 0.5);
}

TEST_F(ItemTypesTest, WhatCannotBeReadShowsWhileEditing)
{
    add(ImageItem::type, frame(20, 10), {{"file", "lost.png"}});
    struct {
        PaintPurpose purpose;
        std::size_t texts;
    } const cases[] = {{PaintPurpose::Edit, 1}, {PaintPurpose::Play, 0}, {PaintPurpose::Export, 0}};
    for (const auto& c : cases) {
        test::RecordingPainter recorded;
        BlindPainter view(recorded);
        paintScene(scene, nullptr, c.purpose, Box({-100, -100}, {100, 100}), view);
        EXPECT_EQ(recorded.texts().size(), c.texts);
    }
}

}  // namespace
}  // namespace jet
