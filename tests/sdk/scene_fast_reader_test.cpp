// Text that JET wrote is read another way than text somebody edited. Both must come to the same: here each text is read
// as it is, and once more with a comment after it, which only the thorough reader takes.
#include "geometry_samples.hpp"
#include "scene_fakes.hpp"

#include <jet/project.hpp>

namespace jet {
namespace {

class SceneFastReaderTest : public test::SceneFixture {
protected:
    /// The hash of the scene read, else the message (without the place: the end of the text is elsewhere with a
    /// comment).
    std::string outcome(std::string text)
    {
        std::vector<FormatNote> notes;
        const auto read = readSceneText(std::move(text), "a.scene", events, catalog, notes);
        std::string result = read ? std::to_string((*read)->hash()) : read.error().message;
        for (const FormatNote& note : notes) result += "\n" + Error(note.message, note.where).text();
        return result;
    }
    void expectSame(const std::string& text) { ASSERT_EQ(outcome(text), outcome(text + "<!-- -->\n")) << text; }

    std::string sample()
    {
        test::Random random(3);
        auto edit = items().begin("Fill");
        const Item& group = edit.add<GroupItem>(layer());
        const Item& ball = edit.add<BodyItem>(group, Path::ellipse(Box({0.1, -2.5}, {1e-7, 1e20})));
        edit.set(ball, "name", "<Ball> & \"Söhne\"");
        edit.set(ball, "velocity", Vec2(0.1, -1.0 / 3));
        edit.addEffect(ball, "tint", {{"note", "two\nlines & <tags>"}, {"color", Color{1, 2, 3, 4}}});
        edit.setEffect(ball, edit.addEffect(ball, "hook"), "visible", false);
        edit.set(edit.add<ScriptItem>(group), "code", "if (a < b && c) {\n\tprint(\"x\");\n}\n");
        const Item& rope = edit.add("rope", layer(), Path::line({1, 2}, {3, 4}));
        edit.set(rope, "target", ball.id());
        edit.set(rope, "locked", true);
        edit.set(group, "visible", false);
        edit.add<GroupItem>(group);
        for (int i = 0; i < 8; ++i) {
            Path path = Path::polygon(std::array{random.point(), random.point(1e9), random.point(1e-3)}, i % 2 == 0);
            path.cubicTo(random.point(), random.point(), random.point());
            if (i % 3 == 0) path.close();
            if (i % 4 == 0) path.segment(0).in += Vec2(1, 1), path.setIntermediate(3);
            edit.add<ShapeItem>(layer(), path);
        }
        edit.setScene("gravity", Vec2(0, -9.81));
        MaterialTable materials("ground");
        materials.add("ice & snow");
        edit.setMaterials(materials);
        edit.commit();
        return writeSceneText(scene);
    }
};

TEST_F(SceneFastReaderTest, WhatWasWrittenReadsBackAsTheSameScene)
{
    const std::string text = sample();
    EXPECT_EQ(outcome(text), std::to_string(scene.hash()));
    expectSame(text);
}

TEST_F(SceneFastReaderTest, DamagedTextsReadAsTheThoroughReaderReadsThem)
{
    const std::string text = sample();
    const std::string pieces[] = {
        "\"", "<",  ">",    "&",   "&amp;",     "&#65;",     "\n",
        " ",  "0",  "-",    "e9",  ".",         "Z",         "M 1 2",
        "é",  "\r", "\xff", "]]>", "<![CDATA[", "</item>\n", "<item type=\"shape\" id=\"99\" name=\"x\"/>\n"};
    test::Random random(11);
    for (int i = 0; i < 3000; ++i) {
        std::string damaged = text;
        const std::size_t at = random.index(text.size());
        switch (i % 3) {
        case 0: damaged.erase(at, 1 + random.index(12)); break;
        case 1: damaged.insert(at, pieces[random.index(std::size(pieces))]); break;
        default: damaged[at] = static_cast<char>(32 + random.index(95));
        }
        if (!damaged.ends_with("</scene>\n")) continue;
        ASSERT_NO_FATAL_FAILURE(expectSame(damaged));
    }
}

TEST_F(SceneFastReaderTest, NumbersReadToTheSameBits)
{
    test::Random random(5);
    std::string path = "M 0 0";
    const char* samples[] = {"0.1",
                             "-0",
                             "-0.0",
                             "123456789012345",
                             "1234567890123456",
                             "0.000000000000001",
                             "4.35",
                             "1e22",
                             "1e-7",
                             "-1.5e+3",
                             "9007199254740993",
                             "1.7976931348623157e308",
                             "5e-324",
                             "0.30000000000000004",
                             "2.2250738585072014e-308",
                             "100000000000000.1",
                             "007.50"};
    for (const char* a : samples)
        for (const char* b : samples) path += std::string(" L ") + a + " " + b;
    for (int i = 0; i < 20000; ++i) {
        const double value = std::round(random.real(-1e6, 1e6) * 1000) / 1000;
        path += " L " + numberText(value) + " " + numberText(random.real(-1, 1));
    }
    const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene version=\"1\">\n";
    expectSame(head + "  <item type=\"shape\" id=\"1\" name=\"a\">\n    <path>" + path +
               "</path>\n  </item>\n</scene>\n");
}

TEST_F(SceneFastReaderTest, GroupsAThousandDeepAreReadAndDeeperOnesRefused)
{
    for (const int depth : {1000, 1001}) {
        std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene version=\"1\">\n";
        for (int i = 1; i <= depth; ++i)
            text += "  <item type=\"group\" id=\"" + std::to_string(i) + "\" name=\"g\">\n";
        for (int i = 1; i <= depth; ++i) text += "  </item>\n";
        text += "</scene>\n";
        expectSame(text);
        EXPECT_EQ(outcome(text).find("1000 deep") != std::string::npos, depth > 1000);
    }
}

}  // namespace
}  // namespace jet
