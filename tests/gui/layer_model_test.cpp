#include "layers/layer_model.hpp"
#include "window_fixture.hpp"

#include <jet/ui/icons.hpp>

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QMimeData>

namespace jet::test {

using layers::LayerModel;

/// The model of the front scene, watched by Qt's own checker of model rules.
class LayerModelTest : public WindowFixture {
protected:
    LayerModelTest() : model_(window(), nullptr)
    {
        model_.setScene(&scene());
        tester_ =
            std::make_unique<QAbstractItemModelTester>(&model_, QAbstractItemModelTester::FailureReportingMode::Fatal);
        layer_ = scene().root().children().front().get();
    }
    ~LayerModelTest() override { tester_.reset(); }

    const Item& add(const Item& parent, const char* name, std::string_view type = ShapeItem::type)
    {
        auto edit = scene().items().begin("Add");
        const Item& item = edit.add(type, parent, Path::rectangle(Box({0, 0}, {9, 9})));
        edit.set(item, "name", name);
        edit.commit();
        model_.flush();
        return item;
    }
    QStringList names(const QModelIndex& parent)
    {
        model_.flush();
        if (model_.canFetchMore(parent)) model_.fetchMore(parent);
        QStringList names;
        for (int row = 0; row < model_.rowCount(parent); ++row) names << model_.index(row, 0, parent).data().toString();
        return names;
    }
    void drop(const Item& item, const QModelIndex& parent, int row)
    {
        const std::unique_ptr<QMimeData> data(model_.mimeData({model_.indexOf(item.id())}));
        model_.dropMimeData(data.get(), Qt::MoveAction, row, 0, parent);
    }

    LayerModel model_;
    std::unique_ptr<QAbstractItemModelTester> tester_;
    const Item* layer_;
};

TEST_F(LayerModelTest, ShowsItemsInTreeOrderAndFollowsUndo)
{
    add(*layer_, "first");
    add(*layer_, "second");
    const QModelIndex layer = model_.indexOf(layer_->id());
    EXPECT_EQ(names(layer), (QStringList{"first", "second"}));
    scene().undoRedo().undo();
    EXPECT_EQ(names(layer), QStringList{"first"});
    scene().undoRedo().redo();
    EXPECT_EQ(names(layer), (QStringList{"first", "second"}));
}

TEST_F(LayerModelTest, ABurstOfChangesIsFollowedOnce)
{
    const QModelIndex layer = model_.indexOf(layer_->id());
    ASSERT_TRUE(names(layer).isEmpty());
    int updates = 0;
    QObject::connect(&model_, &LayerModel::updated, [&] { ++updates; });
    for (int i = 0; i < 1000; ++i) {
        auto edit = scene().items().begin("Add");
        edit.add<ShapeItem>(*layer_, Path::rectangle(Box({0, 0}, {9, 9})));
        if (i % 3 == 0) edit.remove(*layer_->children().front());
        edit.commit();
    }
    EXPECT_EQ(updates, 0);
    QApplication::processEvents();
    EXPECT_EQ(updates, 1);
    EXPECT_EQ(model_.rowCount(layer), static_cast<int>(layer_->children().size()));
}

TEST_F(LayerModelTest, ABurstMayAddFillAndRemoveGroups)
{
    const QModelIndex layer = model_.indexOf(layer_->id());
    const Item& kept = add(*layer_, "kept", GroupItem::type);
    names(layer), names(model_.indexOf(kept.id()));
    auto edit = scene().items().begin("Many");
    const Item& group = edit.add<GroupItem>(*layer_);
    const Item& inner = edit.add<ShapeItem>(group, Path::rectangle(Box({0, 0}, {9, 9})));
    edit.commit();
    auto move = scene().items().begin("Move");
    move.move(inner, kept, 0);
    move.remove(group);
    move.commit();
    QApplication::processEvents();
    EXPECT_EQ(model_.rowCount(layer), 1);
    EXPECT_EQ(model_.rowCount(model_.indexOf(kept.id())), 1);
    EXPECT_EQ(model_.idOf(model_.indexOf(inner.id())), inner.id());
}

TEST_F(LayerModelTest, RenamingShowingAndLockingAreTransactions)
{
    const Item& item = add(*layer_, "old");
    const QModelIndex row = model_.indexOf(item.id());
    EXPECT_TRUE(model_.setData(row, "new", Qt::EditRole));
    EXPECT_EQ(item.name(), "new");
    EXPECT_FALSE(model_.setData(row, "   ", Qt::EditRole));
    model_.setData(row.siblingAtColumn(layers::Visible), false, Qt::EditRole);
    model_.setData(row.siblingAtColumn(layers::Locked), true, Qt::EditRole);
    EXPECT_FALSE(item.visible());
    EXPECT_TRUE(item.locked());
    for (int i = 0; i < 3; ++i) scene().undoRedo().undo();
    EXPECT_EQ(item.name(), "old");
}

TEST_F(LayerModelTest, DroppingBetweenRowsReordersWithinTheLayer)
{
    const Item& a = add(*layer_, "a");
    add(*layer_, "b");
    add(*layer_, "c");
    const QModelIndex layer = model_.indexOf(layer_->id());
    ASSERT_EQ(names(layer), (QStringList{"a", "b", "c"}));
    drop(a, layer, 2);  // between b and c
    EXPECT_EQ(names(layer), (QStringList{"b", "a", "c"}));
    drop(a, layer, 3);  // below c
    EXPECT_EQ(names(layer), (QStringList{"b", "c", "a"}));
    drop(a, layer, 0);
    EXPECT_EQ(names(layer), (QStringList{"a", "b", "c"}));
}

TEST_F(LayerModelTest, DroppingOnAGroupPutsTheItemLastIntoIt)
{
    const Item& group = add(*layer_, "group", GroupItem::type);
    add(group, "inside");
    const Item& item = add(*layer_, "item");
    const QModelIndex row = model_.indexOf(group.id());
    ASSERT_EQ(names(row), QStringList{"inside"});
    drop(item, row, -1);
    EXPECT_EQ(names(row), (QStringList{"inside", "item"}));
    EXPECT_EQ(item.parent(), &group);
}

TEST_F(LayerModelTest, AGroupCannotBeDroppedIntoItself)
{
    const Item& group = add(*layer_, "group", GroupItem::type);
    const std::uint64_t before = scene().hash();
    drop(group, model_.indexOf(group.id()), -1);
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(LayerModelTest, FollowsALayerOfAHundredThousandItems)
{
    tester_.reset();  // it visits every row at every change
    auto edit = scene().items().begin("Fill");
    for (int i = 0; i < 100000; ++i) edit.add<ShapeItem>(*layer_, Path::line({0, 0}, {1, 1}));
    edit.commit();
    const QModelIndex layer = model_.indexOf(layer_->id());
    model_.fetchMore(layer);
    ASSERT_EQ(model_.rowCount(layer), 100000);
    add(*layer_, "one more");
    EXPECT_EQ(model_.rowCount(layer), 100001);
}

class LayerIconsTest : public WindowFixture {
protected:
    LayerIconsTest() : WindowFixture({"org.jet.items.physics", "org.jet.tool.selection"}), model_(window(), nullptr)
    {
        model_.setScene(&scene());
    }
    QModelIndex add(std::string_view type)
    {
        auto edit = scene().items().begin("Add");
        const Item& item = edit.add(type, scene().root());
        edit.commit();
        model_.flush();
        return model_.indexOf(item.id());
    }
    QImage icon(std::string_view type)
    {
        return qvariant_cast<QIcon>(add(type).data(Qt::DecorationRole)).pixmap(24).toImage();
    }
    LayerModel model_;
};

TEST_F(LayerIconsTest, KindsOfItemsOfPluginsShowTheirOwnIconAndName)
{
    const QImage unknown = ui::icon("unknown").pixmap(24).toImage();
    EXPECT_FALSE(icon("joint").isNull());
    EXPECT_NE(icon("joint"), unknown);
    EXPECT_NE(icon("force-field"), unknown);
    EXPECT_NE(icon("joint"), icon("force-field"));
    EXPECT_EQ(add("force-field").data(Qt::ToolTipRole).toString(), "Force field");
    EXPECT_EQ(add(ShapeItem::type).data(Qt::ToolTipRole).toString(), "Shape");
}

}  // namespace jet::test
