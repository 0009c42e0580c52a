#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin", "org.jet.effect.in-path-rigid-body", "org.jet.physics"}
    {
        apply("in-path-rigid-body", ball);
        auto edit = items().begin("Name");
        edit.set(ball, "name", "Ball");
        edit.commit();
    }
    void script(std::string code)
    {
        auto edit = items().begin("Script");
        const jet::Item& item = edit.add("script", items().root());
        edit.set(item, "code", std::move(code));
        edit.commit();
    }

    const jet::Item& ball = addRectangle({{0, 0}, {10, 10}});
};

TEST_F(MyPluginTest, SaysWhatTheScriptSays)
{
    script("say Hello there\n");
    const auto simulation = play();
    ASSERT_EQ(simulation->output().size(), 1u);
    EXPECT_EQ(simulation->output()[0].text, "Hello there");
}

TEST_F(MyPluginTest, PushesABodyWhileTheKeyIsHeld)
{
    script("on D push Ball 4000 0\n");
    const auto simulation = play();
    const auto x = [&] { return simulation->pose(ball)->bounds().center().x(); };
    for (int i = 0; i < 10; ++i) simulation->step();
    EXPECT_NEAR(x(), 5, 1e-9) << "the key is not held";
    simulation->setKey("D", true);
    for (int i = 0; i < 10; ++i) simulation->step();
    EXPECT_GT(x(), 5.1);
}

TEST_F(MyPluginTest, NamesTheLineOfAMistake)
{
    script("say Hello\non D push Nobody 1 0\n");
    const auto simulation = play();
    ASSERT_EQ(simulation->output().size(), 2u);
    EXPECT_NE(simulation->output()[1].text.find("Nobody"), std::string::npos) << simulation->output()[1].text;
}

}  // namespace
