// NumberEdit: a spin box for real and whole numbers that shows the exact value with as few digits as tell it apart.
//
// QDoubleSpinBox rounds to a fixed count of decimals: 0.0125 entered in an Inspector would come back as 0.01.
// Expressions and units are read, too (number_expression.hpp); what cannot be read stays, marked, with the reason
// beside it.
#pragma once

#include <jet/property.hpp>

#include <QAbstractSpinBox>

#include <functional>
#include <optional>

namespace jet::ui {

class NumberEdit final : public QAbstractSpinBox {
public:
    NumberEdit(const PropertySpec& spec, QWidget* parent);

    /// None: several values that differ.
    void setNumber(std::optional<double> number);
    std::optional<double> number() const { return number_; }
    /// `done` is false while the user spins.
    void setHandler(std::function<void(double number, bool done)> handler) { handler_ = std::move(handler); }

    void stepBy(int steps) override;
    QValidator::State validate(QString& input, int& position) const override;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    StepEnabled stepEnabled() const override;
    void wheelEvent(QWheelEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;

private:
    Result<double> read(const QString& text) const;
    void showProblem(const QString& message);
    double step() const;
    void accept(double number, bool done);
    void showNumber();
    QString textOf(double number) const;
    void finish();

    bool whole_;
    double minimum_, maximum_;
    std::string unit_;
    QString suffix_;
    QString toolTip_;  // of the field, while a problem is shown
    bool wrong_ = false;
    std::optional<double> number_;
    bool spinning_ = false;  // the last change was one of several to come
    std::function<void(double, bool)> handler_;
};

}  // namespace jet::ui
