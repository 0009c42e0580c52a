// ToolFixture: tests of tools without a window. The tool is the one from its built library; the scene view is a
// TestToolHost.
//
//   class RectangleToolTest : public jet::test::ToolFixture {
//   protected:
//       RectangleToolTest() : ToolFixture{"org.jet.tool.rectangle", "org.jet.effect.polygon-face"} {}
//   };
//   TEST_F(RectangleToolTest, ADragMakesOneShape)
//   {
//       tool("rectangle").drag({10, 10}, {60, 40});
//       ASSERT_EQ(shapes().size(), 1u);
//       undo();
//       EXPECT_EQ(scene().hash(), emptySceneHash());
//   }
#pragma once

#include "support/test_catalog.hpp"

#include <jet/scene.hpp>
#include <jet/tool.hpp>

#include <gtest/gtest.h>

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace jet::test {

/// A scene view without a window: 1 pixel a scene unit unless told otherwise.
class TestToolHost final : public ToolHost {
public:
    explicit TestToolHost(Scene& scene) : scene_(scene) {}

    Scene& scene() override { return scene_; }
    const Item& insertionPoint(Transaction& edit) override;
    Pen layerPen() const override
    {
        Pen pen;
        pen.color = {0, 120, 215, 255};
        pen.cosmetic = true;
        return pen;
    }
    double pixelsPerUnit() const override { return scale; }
    void requestRepaint() override { ++repaints; }
    void showStatus(std::string text) override { status = std::move(text); }
    void setCursor(std::string_view name) override { cursor = name; }
    const Properties& options() const override { return values; }
    void switchTool(std::string_view id) override { wantedTool = id; }

    double scale = 1;
    int repaints = 0;
    std::string status, cursor, wantedTool;
    Properties values;  ///< of the tool's options

private:
    Scene& scene_;
};

/// Feeds one tool with events as a scene view does. Pixels follow from the host's scale, with the origin at the
/// top-left. Everything returns the driver, so that gestures read as a line.
class ToolDriver {
public:
    ToolDriver(TestToolHost& host, std::unique_ptr<Tool> tool);
    ~ToolDriver();

    Tool& operator*() { return *tool_; }
    Tool* operator->() { return tool_.get(); }

    /// Modifiers held from now on.
    ToolDriver& hold(Modifiers modifiers);
    ToolDriver& press(const Vec2& at);
    /// A drag while the button is down, else a move.
    ToolDriver& move(const Vec2& to);
    ToolDriver& release();
    ToolDriver& click(const Vec2& at);
    ToolDriver& doubleClick(const Vec2& at);
    /// Press, several moves on the straight line, release.
    ToolDriver& drag(const Vec2& from, const Vec2& to, int steps = 4);
    ToolDriver& wheel(const Vec2& at, double steps);
    /// A key as the view delivers it: Escape asks cancel() first and reaches keyPress() when no gesture was under way.
    ToolDriver& key(std::string_view key);
    /// Did the tool use the last key?
    bool used() const { return used_; }

private:
    PointerEvent at(const Vec2& scene) const;

    TestToolHost& host_;
    std::unique_ptr<Tool> tool_;
    Modifiers modifiers_;
    Vec2 position_;
    bool down_ = false;
    bool used_ = false;
};

/// One empty scene and the tools of the given plugins.
class ToolFixture : public testing::Test {
protected:
    explicit ToolFixture(std::initializer_list<std::string_view> plugins);
    ~ToolFixture() override;

    /// The tool of that id, made and activated on first use. Switching to another deactivates the one before.
    ToolDriver& tool(std::string_view id);
    TestToolHost& host() { return host_; }
    Scene& scene() { return scene_; }
    ItemsCenter& items() { return scene_.items(); }
    TestCatalog& catalog() { return catalog_; }
    std::uint64_t emptySceneHash() const { return emptyHash_; }

    /// All items of a type, in tree order.
    std::vector<const Item*> itemsOf(std::string_view type) const;
    std::vector<const Item*> shapes() const { return itemsOf(ShapeItem::type); }
    std::vector<const Item*> selected();
    std::size_t undoSteps() const { return scene_.undoRedo().position(); }
    void undo() { scene_.undoRedo().undo(); }
    void redo() { scene_.undoRedo().redo(); }

    /// Adds an item as an own undo step; to the top group when no parent is given.
    const Item& add(std::string_view type, Path path, const Item* parent = nullptr);
    const Item& addRectangle(const Box& box, const Item* parent = nullptr)
    {
        return add("shape", Path::rectangle(box), parent);
    }

private:
    TestCatalog catalog_;
    EventsCenter events_;
    Scene scene_;
    TestToolHost host_;
    std::uint64_t emptyHash_;
    std::map<std::string, std::unique_ptr<ToolDriver>, std::less<>> tools_;
    std::string active_;
};

}  // namespace jet::test
