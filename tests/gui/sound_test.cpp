#include "window_fixture.hpp"

#include <jet/format.hpp>

#include <QTest>

namespace jet::test {

/// With a program of the test as the player: it writes down what it was asked to play.
class SoundTest : public WindowFixture {
protected:
    SoundTest() : WindowFixture({"org.jet.tool.selection", "org.jet.physics"})
    {
        EXPECT_TRUE(window().projects().saveAs(folder("game")));
        writeFileAtomically(folder("game") / "ping.ogg", std::string_view("sound")).orThrow();
    }
    void usePlayer(const std::string& script)
    {
        writeFileAtomically(folder("player"), "#!/bin/sh\n" + script).orThrow();
        std::filesystem::permissions(folder("player"), std::filesystem::perms::owner_all);
        window().sounds().setPrograms(
            {{QString::fromStdString(folder("player").string()), false, [](const QString& file, double volume) {
                  return QStringList{file, QString::number(volume)};
              }}});
    }
    void addSound(const char* file, bool loop = false)
    {
        auto edit = scene().items().begin("Add");
        const Item& sound = edit.add<SoundItem>(scene().root(), Path::rectangle(Box({0, 0}, {9, 9})));
        edit.set(sound, "file", file);
        edit.set(sound, "autoplay", true);
        edit.set(sound, "volume", 0.5);
        edit.set(sound, "loop", loop);
        edit.commit();
    }
    std::string log()
    {
        const auto text = readFile(folder("log"));
        return text ? *text : std::string();
    }
    bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 20000); }
    std::string message() { return window().messages().text().toStdString(); }
};

TEST_F(SoundTest, ASoundMarkedToPlayAtStartIsPlayedWithItsVolumeAndEndsWithTheGame)
{
    usePlayer("echo \"$1 $2\" >> " + folder("log").string() + "; exec sleep 1000");
    addSound("ping.ogg");
    trigger("play.play");
    EXPECT_TRUE(eventually([&] { return log() == (folder("game") / "ping.ogg").string() + " 0.5\n"; })) << log();
    EXPECT_EQ(window().sounds().playing(), 1u);
    trigger("play.pause");
    EXPECT_EQ(window().sounds().playing(), 1u);
    trigger("play.stop");
    EXPECT_EQ(window().sounds().playing(), 0u);
    EXPECT_EQ(message(), "");
}

TEST_F(SoundTest, ALoopBeginsAgain)
{
    usePlayer("echo again >> " + folder("log").string() + "; sleep 0.1");
    addSound("ping.ogg", true);
    trigger("play.play");
    EXPECT_TRUE(eventually([&] { return log().starts_with("again\nagain\nagain\n"); })) << log();
    trigger("play.stop");
}

TEST_F(SoundTest, APlayerThatFailsIsToldOfOnceWithItsReason)
{
    usePlayer("echo 'no such device' >&2; exit 1");
    addSound("ping.ogg", true);
    for (int times = 0; times < 2; ++times) {
        trigger("play.play");
        EXPECT_TRUE(eventually([&] { return window().sounds().playing() == 0; }));
        trigger("play.stop");
        if (times == 0) {
            EXPECT_NE(message().find("no such device"), std::string::npos) << message();
            window().messages().clear();
        }
    }
    EXPECT_EQ(message(), "") << "told once";
}

TEST_F(SoundTest, WithoutAPlayerAndWithoutTheFileTheMessageSaysWhatToDo)
{
    window().sounds().setPrograms({});
    addSound("ping.ogg");
    trigger("play.play");
    EXPECT_NE(message().find("Install pipewire-bin"), std::string::npos) << message();
    trigger("play.stop");
    auto edit = scene().items().begin("Change");
    edit.set(*scene().root().children().back(), "file", "gone.ogg");
    edit.commit();
    trigger("play.play");
    EXPECT_NE(message().find("“gone.ogg” is not there"), std::string::npos) << message();
    trigger("play.stop");
}

}  // namespace jet::test
