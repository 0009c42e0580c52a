// The text of scenes: what is written reads back as the same bytes, what was not written by JET reads as meant, and
// what is wrong is told with its place.
#include "scene_fakes.hpp"

#include <jet/project.hpp>

#include <gmock/gmock.h>

namespace jet {
namespace {

using testing::HasSubstr;

const std::string kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene version=\"1\">\n";
const std::string kTail = "</scene>\n";

class SceneTextTest : public test::SceneFixture {
protected:
    std::unique_ptr<Scene> read(std::string text, Catalog* with = nullptr)
    {
        notes.clear();
        auto scene = readSceneText(std::move(text), "level.scene", events, with ? *with : catalog, notes);
        EXPECT_TRUE(scene) << scene.error().text();
        return scene ? std::move(*scene) : nullptr;
    }
    std::string refusal(std::string text)
    {
        notes.clear();
        const auto scene = readSceneText(std::move(text), "level.scene", events, catalog, notes);
        return scene ? "accepted" : scene.error().text();
    }
    /// A scene with something of everything.
    void fill()
    {
        auto edit = items().begin("Fill");
        const Item& group = edit.add<GroupItem>(layer());
        const Item& ball = edit.add<BodyItem>(group, Path::ellipse(Box({0.1, -0.0}, {1e-7, 1e300})));
        edit.set(ball, "name", "<Ball> & \"Söhne\" \n\t\r]]>");
        edit.set(ball, "velocity", Vec2(0.1, -1.0 / 3));
        edit.addEffect(ball, "tint", {{"note", "two\nlines & <tags>"}, {"color", Color{1, 2, 3, 4}}});
        edit.addEffect(ball, "hook");
        edit.setEffect(ball, 1, "visible", false);
        const Item& script = edit.add<ScriptItem>(group);
        edit.set(script, "code", "if (a < b && c) {\n\tprint(\"x\");\n}\n");
        const Item& odd = edit.add<ScriptItem>(group);
        edit.set(odd, "code", "]]>\r\n\x01 <![CDATA[ &amp; ");
        const Item& rope = edit.add("rope", layer(), Path::line({1, 2}, {3, 4}));
        edit.set(rope, "target", ball.id());
        edit.set(rope, "name", "Rope");
        edit.set(rope, "locked", true);
        edit.set(group, "visible", false);
        edit.setScene("gravity", Vec2(0, -9.81));
        MaterialTable materials("ground");
        materials.add("ice & snow");
        materials.setPair(0, 1, {0.05, 0.3, false});
        edit.setMaterials(materials);
        edit.commit();
    }

    std::vector<FormatNote> notes;
};

TEST_F(SceneTextTest, WhatIsWrittenReadsBackAsTheSameSceneAndBytes)
{
    fill();
    const std::string text = writeSceneText(scene);
    const auto again = read(text);
    EXPECT_EQ(again->hash(), scene.hash());
    EXPECT_EQ(writeSceneText(*again), text);
    EXPECT_TRUE(notes.empty());
}

TEST_F(SceneTextTest, AnEmptySceneIsShort)
{
    Scene empty("Empty", events, catalog);
    EXPECT_EQ(writeSceneText(empty), kHead + kTail);
    EXPECT_EQ(read(kHead + kTail)->hash(), empty.hash());
}

TEST_F(SceneTextTest, ChangingOneValueChangesOneLine)
{
    fill();
    const std::string before = writeSceneText(scene);
    auto edit = items().begin("Change");
    edit.set(*findByName(scene.root(), "Rope"), "length", 51.0);
    edit.commit();
    const std::string after = writeSceneText(scene);
    std::istringstream a(before), b(after);
    int differences = 0;
    for (std::string x, y; std::getline(a, x) && std::getline(b, y);) differences += x != y;
    EXPECT_EQ(differences, 1);
}

TEST_F(SceneTextTest, AHandWrittenSceneReadsAsMeant)
{
    const auto level = read(R"(<scene version='1'>
  <!-- made by hand -->
  <settings>
    <property id="gravity">0 9.81</property>
  </settings>
  <item type="layer" id="10" name="Ground">
    <item type="shape" id="20" name="Hill" visible="false">
      <path>m 0,0 h 100 v 50 z</path>
      <effect type="tint"><property id="color">tomato</property></effect>
    </item>
    <item type="script" id="30" name="Script">
      <property id="code">
        <![CDATA[print("1 < 2");]]>
      </property>
    </item>
  </item>
</scene>)");
    ASSERT_NE(level, nullptr);
    EXPECT_EQ(level->setting("gravity"), Value(Vec2(0, 9.81)));
    const Item& hill = *level->items().find(ItemId{20});
    EXPECT_EQ(hill.path().bounds(), Box({0, 0}, {100, 50}));
    EXPECT_FALSE(hill.visible());
    EXPECT_EQ(*hill.effects()[0].properties.find("color"), Value(Color{255, 99, 71, 255}));
    EXPECT_THAT(level->items().find(ItemId{30})->properties().find("code")->as<std::string>(),
                HasSubstr("print(\"1 < 2\");"));
    auto edit = level->items().begin("Add");
    EXPECT_EQ(edit.add<ShapeItem>(level->root()).id(), ItemId{31}) << "new ids start above the largest";
}

// --- what a missing plugin wrote

TEST_F(SceneTextTest, WithAnySubsetOfPluginsTheBytesStayTheSame)
{
    fill();
    const std::string text = writeSceneText(scene);
    for (int subset = 0; subset < 8; ++subset) {
        test::TestCatalog some;
        if (subset & 1) some.inCode().effect<test::TintEffect>("tint");
        if (subset & 2) some.inCode().effect<test::HookEffect>("hook");
        if (subset & 4) some.inCode().itemType<test::RopeType>("rope");
        const auto again = read(text, &some);
        ASSERT_NE(again, nullptr);
        EXPECT_EQ(writeSceneText(*again), text) << "subset " << subset;
        EXPECT_EQ(notes.size(), static_cast<std::size_t>(3 - (subset & 1) - (subset >> 1 & 1) - (subset >> 2 & 1)));
    }
}

TEST_F(SceneTextTest, APlaceholderCanBeMovedCopiedDeletedAndUndone)
{
    fill();
    const std::string text = writeSceneText(scene);
    test::TestCatalog none;
    const auto bare = read(text, &none);
    const Item& rope = *findByName(bare->root(), "Rope");
    const Item& parent = *rope.parent();
    auto edit = bare->items().begin("Use");
    edit.move(rope, bare->root(), 0);
    const Item& copy = edit.addCopy(rope, parent);
    EXPECT_EQ(copy.properties(), rope.properties());
    edit.transform(copy, Affine::translation({1, 1}));
    edit.remove(rope);
    EXPECT_THAT(failure([&] { edit.set(copy, "length", 3.0); }), HasSubstr("rope"));
    edit.commit();
    bare->undoRedo().undo();
    EXPECT_EQ(writeSceneText(*bare), text);
}

TEST_F(SceneTextTest, APropertyTheEffectDoesNotKnowIsKeptAndTold)
{
    const std::string text = kHead +
                             "  <item type=\"shape\" id=\"1\" name=\"S\">\n"
                             "    <path>M 0 0 L 1 1</path>\n"
                             "    <property id=\"glow\">very &lt;bright&gt;</property>\n"
                             "    <effect type=\"tint\">\n"
                             "      <property id=\"width\">3</property>\n"
                             "      <property id=\"zz-new\">1 2 3</property>\n"
                             "    </effect>\n"
                             "  </item>\n" +
                             kTail;
    const auto level = read(text);
    EXPECT_EQ(writeSceneText(*level), text);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_THAT(notes[0].message, HasSubstr("no property 'glow'"));
    EXPECT_EQ(notes[0].where.line, 5);
}

// --- wrong input: place and remedy

struct Wrong {
    const char* name;
    std::string body;     // inside <scene version="1">, from line 2 on
    const char* message;  // file:line:col: error: ...
};

std::string item(const std::string& content, const std::string& attributes = R"(type="shape" id="1" name="S")")
{
    return "<item " + attributes + ">" + content + "</item>";
}

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.name; }

const std::vector<Wrong>& wrongs()
{
    static const std::vector<Wrong> all{
        {"Truncated", "<item type=\"shape\" id=\"1\"", "level.scene:3:1: error: this is not well-formed XML"},
        {"MismatchedTags", "<item>\n</group>", "level.scene:3:"},
        {"StrayText", "hello", "level.scene:2:1: error: stray text here"},
        {"UnknownElement", "<thing/>", "level.scene:2:2: error: <thing> is not known here; a scene holds"},
        {"UnknownElementInItem", item("<shape/>"), ": error: <shape> is not known here; an item holds"},
        {"UnknownElementInEffect", item("<effect type=\"tint\"><path/></effect>"), "an effect holds <property>"},
        {"UnknownElementInSettings", "<settings><item/></settings>", "<settings> holds <property>"},
        {"UnknownElementInMaterials", "<materials><item/></materials>", "<materials> holds"},
        {"UnknownAttribute", item("", R"(type="shape" id="1" name="S" colour="red")"), "has no attribute 'colour'"},
        {"MissingId", item("", R"(type="shape" name="S")"), "level.scene:2:2: error: <item> needs the attribute id"},
        {"MissingType", item("", R"(id="1" name="S")"), "needs the attribute type"},
        {"MissingName", item("", R"(id="1" type="shape")"), "needs the attribute name"},
        {"NegativeId", item("", R"(type="shape" id="-3" name="S")"), "id=\"-3\" is not a whole number from 1"},
        {"ZeroId", item("", R"(type="shape" id="0" name="S")"), "id=\"0\" is not a whole number"},
        {"IdWithLetters", item("", R"(type="shape" id="7a" name="S")"), "id=\"7a\" is not a whole number"},
        {"IdOfTheTopGroup", item("", R"(type="shape" id="18446744073709551615" name="S")"), "is not a whole number"},
        {"IdTooLargeForScripts", item("", R"(type="shape" id="9007199254740992" name="S")"), "is not a whole number"},
        {"DuplicateId", item("") + "\n" + item(""),
         "level.scene:3:2: error: the id 1 is used twice, here and by 'S' before"},
        {"VisibleNeither", item("", R"(type="shape" id="1" name="S" visible="maybe")"),
         "neither \"true\" nor \"false\""},
        {"ChildOfAShape", item(item("", R"(type="shape" id="2" name="T")")), "cannot hold other items"},
        {"NaNCoordinate", item("<path>M 0 0\nL nan 1</path>"), "level.scene:2:"},
        {"InfiniteCoordinate", item("<path>M 0 0 L inf 1</path>"), "the path of 'S'"},
        {"CoordinateTooLarge", item("<path>M 0 0 L 1e999 1</path>"), "the path of 'S'"},
        {"TwoPaths", item("<path>M 0 0 L 1 1</path><path/>"), "<path> stands here twice"},
        {"ElementInPath", item("<path>M 0 0<b/></path>"), "<path> holds text"},
        {"PropertyOfWrongKind", item("<property id=\"omega\">fast</property>", R"(type="body" id="1" name="S")"),
         "property 'omega': Expected a number"},
        {"PropertyNaN", item("<property id=\"omega\">nan</property>", R"(type="body" id="1" name="S")"),
         "property 'omega'"},
        {"PropertyOutOfRange", item("<property id=\"omega\">1e9</property>", R"(type="body" id="1" name="S")"),
         "must be from"},
        {"PropertyTwice",
         item("<property id=\"code\">1</property>\n<property id=\"code\">2</property>",
              R"(type="script" id="1" name="S")"),
         "level.scene:3:2: error: the property 'code' stands here twice"},
        {"PropertyWithoutId", item("<property>1</property>"), "<property> needs the attribute id"},
        {"EffectWithoutType", item("<effect/>"), "<effect> needs the attribute type"},
        {"SettingTwice",
         "<settings><property id=\"gravity\">0 1</property><property id=\"gravity\">0 2</property></settings>",
         "the property 'gravity' stands here twice"},
        {"TwoSettings", "<settings/><settings/>", "<settings> stands here twice"},
        {"SettingOutOfRange", "<settings><property id=\"time-step\">0</property></settings>", "must be from"},
        {"MaterialTwice", "<materials><material name=\"a\"/><material name=\"a\"/></materials>",
         "two materials called 'a'"},
        {"PairOfUnknownMaterial",
         "<materials><material name=\"a\"/><pair a=\"a\" b=\"b\" friction=\"1\" restitution=\"0\"/></materials>",
         "there is no material 'b'"},
        {"NegativeFriction",
         "<materials><material name=\"a\"/><pair a=\"a\" b=\"a\" friction=\"-1\" restitution=\"0\"/></materials>",
         "level.scene:2:33: error: the materials 'a' and 'a': friction is -1; it must be from 0 to 1e+15"},
        {"FrictionNoEngineComputesWith",
         "<materials><material name=\"a\"/>\n<pair a=\"a\" b=\"a\" friction=\"1e40\" restitution=\"0\"/></materials>",
         "level.scene:3:2: error: the materials 'a' and 'a': friction is 1e+40; it must be from 0 to"},
        {"RestitutionAboveOne",
         "<materials><material name=\"a\"/><material name=\"ice\"/>\n"
         "<pair a=\"a\" b=\"ice\" friction=\"1\" restitution=\"2\"/></materials>",
         "level.scene:3:2: error: the materials 'a' and 'ice': restitution is 2; it must be from 0 to 1, where 0 is "
         "no"},
        {"SubstepsOutOfRange", "<settings><property id=\"substeps\">4097</property></settings>", "must be from"},
        {"MethodThereIsNot", "<settings><property id=\"method\">guess</property></settings>", "semi-implicit-euler"},
        {"GravityNoEngineComputesWith", "<settings><property id=\"gravity\">0 1e40</property></settings>",
         "level.scene:2:12: error: Property \"gravity\" must be from"},
        {"NotUtf8", item("", "type=\"shape\" id=\"1\" name=\"\xc3\x28\""),
         "level.scene:2:33: error: this is not UTF-8"},
        {"OverlongUtf8", item("", "type=\"shape\" id=\"1\" name=\"\xc0\x80\""), "this is not UTF-8"},
        {"NulByte", std::string("<item\0/>", 8), "level.scene:2:6: error: there is a NUL byte here"},
        {"NulReference", item("<property id=\"a\">x&#0;y</property>"), "this reference names no character"},
        {"HexNulReference", item("<property id=\"a\">x&#x0;y</property>"), "this reference names no character"},
        {"SurrogateReference", item("", R"(type="shape" id="1" name="&#xD800;")"), "this reference names no character"},
        {"ReferenceTooLarge", item("", R"(type="shape" id="1" name="&#99999999999;")"),
         "this reference names no character"},
        {"LongReference", item("", R"(type="shape" id="1" name="&#xE9)" + std::string(60, 'D') + ";\""),
         "this reference names no character"},
        {"ReferenceAfterAHiddenSection",
         "<?note <![CDATA[ ?>" + item("", R"(type="shape" id="1" name="&#xE9)" + std::string(100, 'E') + ";\""),
         "this reference names no character"},
        {"ReferenceAfterASectionInAnAttribute",
         item("", R"(type="layer" id="1" name="<![CDATA[")") +
             item("", R"(type="shape" id="2" name="&#xE9)" + std::string(100, 'E') + ";\"") + "<!-- ]]> -->",
         "names no character"},
        {"SecondRoot", "</scene><scene version=\"1\">", "there is a second <scene>"},
    };
    return all;
}

class WrongSceneTest : public SceneTextTest, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongSceneTest, IsRefusedWithPlaceAndReason)
{
    const std::string told = refusal("<scene version=\"1\">\n" + GetParam().body + "\n</scene>\n");
    EXPECT_THAT(told, HasSubstr(GetParam().message));
    EXPECT_THAT(told, testing::MatchesRegex("level\\.scene:[0-9]+:[0-9]+: error: (.|\n)+"));
}

INSTANTIATE_TEST_SUITE_P(SceneText, WrongSceneTest, testing::ValuesIn(wrongs()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(SceneTextTest, OtherFilesAreRefusedForWhatTheyAre)
{
    EXPECT_THAT(refusal(""), HasSubstr("level.scene:1:1: error: this is not well-formed XML"));
    EXPECT_THAT(refusal("just text"), HasSubstr("not well-formed XML"));
    EXPECT_THAT(refusal("<svg/>"), HasSubstr("a scene file starts with <scene>, this one with <svg>"));
    EXPECT_THAT(refusal("<scene/>"), HasSubstr("needs the attribute version"));
    EXPECT_THAT(refusal("<scene version=\"2\"/>"), HasSubstr("open it with a newer JET"));
    EXPECT_THAT(refusal(std::string("\xff\xfe<\0s\0", 6)), HasSubstr("this is not UTF-8"));
}

TEST_F(SceneTextTest, AByteOrderMarkIsNoMistake)
{
    EXPECT_EQ(refusal("\xef\xbb\xbf<scene version=\"1\"/>"), "accepted");
}

TEST_F(SceneTextTest, EntitiesOfADoctypeAreNotExpanded)
{
    const auto level = read("<!DOCTYPE scene [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]><scene version=\"1\">"
                            "<item type=\"shape\" id=\"1\" name=\"&b;\"/></scene>");
    ASSERT_NE(level, nullptr);
    EXPECT_EQ(level->items().find(ItemId{1})->name(), "&b;");
}

TEST_F(SceneTextTest, AReferenceInsideACdataSectionIsOnlyText)
{
    const auto level = read("<scene version=\"1\"><item type=\"script\" id=\"1\" name=\"&#65;\">"
                            "<property id=\"code\"><![CDATA[x = \"&#0;\";]]></property></item></scene>");
    ASSERT_NE(level, nullptr);
    EXPECT_EQ(*level->items().find(ItemId{1})->properties().find("code"), Value("x = \"&#0;\";"));
    EXPECT_EQ(level->items().find(ItemId{1})->name(), "A");
}

TEST_F(SceneTextTest, TextInPiecesIsReadWhole)
{
    const auto level = read("<scene version=\"1\"><item type=\"script\" id=\"1\" name=\"S\">"
                            "<property id=\"code\">a<!-- no code -->b<![CDATA[<c>]]>d</property></item></scene>");
    ASSERT_NE(level, nullptr);
    EXPECT_EQ(*level->items().find(ItemId{1})->properties().find("code"), Value("ab<c>d"));
}

TEST_F(SceneTextTest, DeepNestingIsRefusedWithoutACrash)
{
    const auto nested = [](int depth) {
        std::string text = "<scene version=\"1\">", tail;
        for (int i = 1; i <= depth; ++i) {
            text += "<item type=\"group\" id=\"" + std::to_string(i) + "\" name=\"G\">";
            tail += "</item>";
        }
        return text + tail + "</scene>";
    };
    const auto deepest = read(nested(1000));
    ASSERT_NE(deepest, nullptr);
    EXPECT_EQ(read(writeSceneText(*deepest))->hash(), deepest->hash());
    EXPECT_THAT(refusal(nested(1001)), HasSubstr("items are nested more than 1000 deep"));
    EXPECT_THAT(refusal(nested(200'000)), HasSubstr("items are nested more than 1000 deep"));
}

// Each truncation of a valid scene is refused; none crashes (and the sanitizers see no bad read).
TEST_F(SceneTextTest, NoTruncationIsAccepted)
{
    fill();
    const std::string text = writeSceneText(scene);
    for (std::size_t length = 0; length + 2 < text.size(); ++length)
        ASSERT_NE(refusal(text.substr(0, length)), "accepted") << length;
}

// Flipped bytes may make another valid scene; then it must read back as itself.
TEST_F(SceneTextTest, DamagedBytesGiveAMessageOrAScene)
{
    fill();
    const std::string text = writeSceneText(scene);
    for (std::size_t at = 0; at < text.size(); ++at)
        for (const char with : {'<', '&', '"', '\0', '9', '-'}) {
            std::string damaged = text;
            damaged[at] = with;
            notes.clear();
            const auto level = readSceneText(damaged, "level.scene", events, catalog, notes);
            if (!level) continue;
            const std::string written = writeSceneText(**level);
            const auto again = readSceneText(written, "level.scene", events, catalog, notes);
            ASSERT_TRUE(again) << again.error().text();
            ASSERT_EQ((*again)->hash(), (*level)->hash()) << "byte " << at << " as " << with;
        }
}

}  // namespace
}  // namespace jet
