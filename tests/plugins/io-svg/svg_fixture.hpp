// SvgTest: imports a drawing written in the test into an empty scene.
#pragma once

#include "support/test_catalog.hpp"

#include <jet/format.hpp>
#include <jet/scene.hpp>

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace jet::test {

class SvgTest : public testing::Test {
protected:
    /// Imports a whole file.
    Result<void> importText(std::string_view file)
    {
        auto edit = scene_.items().begin("Import");
        ImportRequest request{"drawing.svg", std::as_bytes(std::span(file)), edit, scene_.root(), notes_, {}};
        Result<void> result = catalog_.importer("svg")->read(request);
        if (result) edit.commit();
        return result;
    }

    /// Imports the content of an <svg> of the given attributes; fails the test if that fails.
    void draw(std::string_view content, std::string_view attributes = "width='200' height='100'")
    {
        const std::string file = "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
                                 "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' " +
                                 std::string(attributes) + ">\n" + std::string(content) + "</svg>";
        const Result<void> result = importText(file);
        ASSERT_TRUE(result) << result.error().text();
    }

    std::vector<const Item*> items(std::string_view type) const
    {
        std::vector<const Item*> found;
        scene_.root().walk([&](const Item& item) {
            if (item.type() == type && item.parent()) found.push_back(&item);
        });
        return found;
    }
    std::vector<const Item*> shapes() const { return items(ShapeItem::type); }
    /// The only shape.
    const Item& shape() const
    {
        EXPECT_EQ(shapes().size(), 1u);
        return shapes().empty() ? scene_.root() : *shapes().front();
    }
    const Item* named(std::string_view name) const { return findByName(scene_.root(), name); }
    Box bounds() const { return shape().bounds(); }

    /// "#rrggbb" of the face; "none" where there is none.
    static std::string face(const Item& item) { return colorOf(item, "polygon-face"); }
    static std::string strokeColor(const Item& item) { return colorOf(item, "stroke"); }
    template <class T>
    static T strokeValue(const Item& item, std::string_view property)
    {
        const EffectInstance* stroke = item.effect("stroke");
        return stroke ? stroke->properties.find(property)->as<T>() : T();
    }

    /// Is there a note with these words? At that line, if one is given.
    bool noted(std::string_view words, int line = 0) const
    {
        for (const FormatNote& note : notes_) {
            if (note.message.find(words) != std::string::npos && (line == 0 || note.where.line == line)) return true;
        }
        return false;
    }
    std::string allNotes() const
    {
        std::string text;
        for (const FormatNote& note : notes_) {
            text +=
                std::to_string(note.where.line) + ":" + std::to_string(note.where.column) + ": " + note.message + "\n";
        }
        return text;
    }

    TestCatalog catalog_{"org.jet.io-svg", "org.jet.effect.polygon-face", "org.jet.effect.stroke"};
    EventsCenter events_;
    Scene scene_{"Scene", events_, catalog_};
    std::vector<FormatNote> notes_;

private:
    static std::string colorOf(const Item& item, std::string_view effect)
    {
        const EffectInstance* instance = item.effect(effect);
        return instance ? instance->properties.find("color")->as<Color>().text() : "none";
    }
};

inline void expectBox(const Box& actual, const Box& expected, double tolerance = 1e-9)
{
    EXPECT_NEAR(actual.min.x(), expected.min.x(), tolerance);
    EXPECT_NEAR(actual.min.y(), expected.min.y(), tolerance);
    EXPECT_NEAR(actual.max.x(), expected.max.x(), tolerance);
    EXPECT_NEAR(actual.max.y(), expected.max.y(), tolerance);
}

}  // namespace jet::test
