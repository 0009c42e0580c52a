// The widget of the Physics panel: check boxes for the marks, a slider over the kept past, and a table of numbers.
#pragma once

#include <jet/editor.hpp>
#include <jet/physics_view.hpp>

#include <QWidget>

#include <vector>

class QCheckBox;
class QLabel;
class QSlider;
class QTableWidget;
class QTimer;

namespace jet::panels {

/// Everything that can be drawn; not the statistics.
PhysicsMarks allMarks();

class PhysicsWidget final : public QWidget {
public:
    explicit PhysicsWidget(Editor& editor, QWidget* parent = nullptr);
    ~PhysicsWidget() override;

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    QWidget* createMarks();
    QWidget* createRewind();
    QWidget* createTable();
    void changeMark(bool PhysicsMarks::*mark, bool on);
    void showMarks();
    void refresh();
    void showRewind();
    void showNumbers();

    Editor& editor_;
    std::vector<std::pair<QCheckBox*, bool PhysicsMarks::*>> boxes_;
    QSlider* slider_ = nullptr;
    QLabel *from_ = nullptr, *now_ = nullptr, *memory_ = nullptr;
    QTableWidget* table_ = nullptr;
    QTimer* timer_ = nullptr;
    Subscription frames_, states_, marks_;
};

}  // namespace jet::panels
