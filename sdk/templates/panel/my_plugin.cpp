// A panel: how many shapes the scene in front has, and a button that selects them all.
#include <jet/editor.hpp>
#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

#include <QCoreApplication>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QWidget>

namespace {

QString translated(const char* text) { return QCoreApplication::translate("MyPlugin", text); }

class MyPluginWidget final : public QWidget {
public:
    explicit MyPluginWidget(jet::Editor& editor) : editor_(editor)
    {
        count_->setObjectName("count");
        select_->setObjectName("select");
        auto* column = new QVBoxLayout(this);
        column->addWidget(count_);
        column->addWidget(select_);
        column->addStretch();
        connect(select_, &QPushButton::clicked, this, [this] { selectAll(); });
        // Subscriptions end with the widget. Senders: null is anyone, here the editor and every scene.
        sceneChanged_ = editor_.events().subscribe<jet::ActiveSceneChanged>(
            nullptr, [this](const jet::ActiveSceneChanged&) { show(); });
        itemsChanged_ =
            editor_.events().subscribe<jet::ItemsChanged>(nullptr, [this](const jet::ItemsChanged&) { show(); });
        show();
    }

private:
    std::vector<jet::ItemId> shapes() const
    {
        std::vector<jet::ItemId> found;
        if (const jet::Scene* scene = editor_.activeScene())
            scene->root().walk([&](const jet::Item& item) {
                if (item.is<jet::ShapeItem>()) found.push_back(item.id());
            });
        return found;
    }

    void show()
    {
        const auto count = shapes().size();
        count_->setText(translated("Shapes: %1").arg(count));
        select_->setEnabled(count > 0);
    }

    void selectAll()
    {
        if (jet::Scene* scene = editor_.activeScene()) scene->items().setSelection(shapes());
    }

    jet::Editor& editor_;
    QLabel* count_ = new QLabel(this);
    QPushButton* select_ = new QPushButton(translated("Select all"), this);
    jet::Subscription sceneChanged_, itemsChanged_;
};

class MyPluginPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new MyPluginWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<MyPluginPanel>("my-plugin"); }
