// How a scene is solved is a matter of its settings.
#include "live_scene.hpp"

namespace jet::test {

namespace {

class SceneSettings : public LiveSceneOfEngine {
protected:
    void build()
    {
        box({{-500, 100}, {500, 140}}, {{"fixed", true}});
        resting_ = box({{-10, 80}, {10, 100}});
    }
    bool awake() { return simulation_->world().awake(simulation_->bodyOf(resting_)); }
    ItemId resting_;
};

TEST_P(SceneSettings, WhatRestsSleepsUnlessTheSceneForbidsIt)
{
    build();
    play(5);
    EXPECT_FALSE(awake());
    simulation_.reset();
    setScene("allow-sleep", false);
    play(5);
    EXPECT_TRUE(awake());
    simulation_.reset();
    scene_.undoRedo().undo();
    play(5);
    EXPECT_FALSE(awake()) << "undone";
}

INSTANTIATE_TEST_SUITE_P(Engines, SceneSettings, testing::Values("jet-physics", "physics-box2d"));

TEST_F(LiveScene, SubstepsAreThoseOfTheScene)
{
    const ItemId falling = box({{-10, -10}, {10, 10}});
    for (const int substeps : {1, 2, 13}) {
        simulation_.reset();
        setScene("substeps", std::int64_t{substeps});
        play(1);
        EXPECT_NEAR(place(falling).y(), 0.5 * 98.1 * (1 + 1.0 / (60 * substeps)), 1e-3) << "g h^2 n (n + 1) / 2";
    }
}

TEST_F(LiveScene, InTeachingModeAStepIsOneOfSemiImplicitEuler)
{
    setScene("method", "semi-implicit-euler");
    setScene("time-step", 0.05);
    const ItemId falling = box({{-10, -10}, {10, 10}});
    play(2);
    EXPECT_NEAR(place(falling).y(), 98.1 * 0.0025 * 40 * 41 / 2, 1e-6) << "g dt^2 n (n + 1) / 2";
    simulation_.reset();
    setScene("method", "automatic");
    play(2);
    EXPECT_NEAR(place(falling).y(), 0.5 * 98.1 * 4, 2) << "g t^2 / 2";
}

class SettingsOfBox2d : public LiveScene {
protected:
    SettingsOfBox2d() : LiveScene("physics-box2d") {}
};

TEST_F(SettingsOfBox2d, AMethodItLacksIsSaidAndItsOwnIsUsed)
{
    if (!hasEngine_) GTEST_SKIP() << "built without Box2D";
    const ItemId falling = box({{-10, -10}, {10, 10}});
    play(1);
    EXPECT_TRUE(printed().empty());
    const Vec2 usual = place(falling);
    simulation_.reset();
    setScene("method", "semi-implicit-euler");
    play(1);
    ASSERT_EQ(printed().size(), 1u);
    EXPECT_THAT(printed()[0], testing::AllOf(testing::HasSubstr("setting 'method'"), testing::HasSubstr("Box2D")));
    EXPECT_EQ(simulation_->output()[0].kind, OutputLine::Kind::Warning);
    EXPECT_EQ(place(falling), usual);
}

}  // namespace

}  // namespace jet::test
