#include "symbol_chooser.hpp"

#include <jet/symbols.hpp>

#include <QApplication>
#include <QInputDialog>

#include <algorithm>

namespace jet::symbols {

namespace {

QString translated(const char* text) { return QApplication::translate("Symbols", text); }

}  // namespace

const Item* chooseSymbol(const Scene& scene, const std::string& title, const Item* likely)
{
    const auto symbols = symbolsOf(scene);
    if (symbols.size() <= 1) return symbols.empty() ? nullptr : symbols.front();
    QStringList names;
    for (const Item* symbol : symbols)
        names += translated("%1 (%n in use)")
                     .replace("%1", QString::fromStdString(symbol->name()))
                     .replace("%n", QString::number(instancesOf(scene, *symbol).size()));
    const auto present = std::ranges::find(symbols, likely);
    const int first = present == symbols.end() ? 0 : static_cast<int>(present - symbols.begin());
    bool accepted = false;
    const QString chosen = QInputDialog::getItem(QApplication::activeWindow(), QString::fromStdString(title),
                                                 translated("Symbol:"), names, first, false, &accepted);
    return accepted ? symbols[static_cast<std::size_t>(names.indexOf(chosen))] : nullptr;
}

std::optional<std::string> askName(const std::string& title, const std::string& present)
{
    bool accepted = false;
    const QString name =
        QInputDialog::getText(QApplication::activeWindow(), QString::fromStdString(title), translated("Name:"),
                              QLineEdit::Normal, QString::fromStdString(present), &accepted);
    if (!accepted || name.trimmed().isEmpty()) return std::nullopt;
    return name.trimmed().toStdString();
}

}  // namespace jet::symbols
