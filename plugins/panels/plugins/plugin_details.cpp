#include "plugin_details.hpp"

#include "plugin_table.hpp"

#include <QStringList>

namespace jet::plugins {

namespace {

QString escaped(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

QString row(const QString& label, const QString& value)
{
    if (value.isEmpty()) return {};
    return QStringLiteral("<tr><td style='padding-right:10px'><b>%1</b></td><td>%2</td></tr>").arg(label, value);
}

QString list(const std::vector<std::string>& texts)
{
    QStringList lines;
    for (const std::string& text : texts) lines << escaped(text);
    return lines.join(QStringLiteral("<br>"));
}

QString contributionsOf(const PluginInfo& plugin)
{
    QStringList lines;
    for (const Contribution& one : plugin.contributions) {
        QString line = QStringLiteral("%1 “%2”").arg(escaped(std::string(kindName(one.kind))), escaped(one.label));
        for (const std::string& extension : one.extensions) line += QStringLiteral(" .") + escaped(extension);
        if (!one.shortcut.empty()) line += QStringLiteral(" (%1)").arg(escaped(one.shortcut));
        lines << line;
    }
    return lines.join(QStringLiteral("<br>"));
}

QString costsOf(const PluginInfo& plugin)
{
    QStringList lines;
    for (const CallbackCost& cost : plugin.callbacks) {
        QString line = translated("%1: %2 calls").arg(escaped(cost.callback)).arg(cost.calls);
        if (cost.totalMs > 0)
            line += translated(", %1 ms, longest %2 ms").arg(cost.totalMs, 0, 'f', 2).arg(cost.longestMs, 0, 'f', 2);
        if (cost.overruns > 0) line += translated(", %1 too long").arg(cost.overruns);
        lines << line;
    }
    return lines.join(QStringLiteral("<br>"));
}

}  // namespace

QString detailsOf(const PluginInfo& plugin)
{
    QString text = QStringLiteral("<h3>%1 %2</h3>").arg(escaped(plugin.name), escaped(plugin.version));
    if (!plugin.description.empty()) text += QStringLiteral("<p>%1</p>").arg(escaped(plugin.description));
    text += QStringLiteral("<table>");
    text += row(translated("State"),
                stateText(plugin) + (plugin.reason.empty() ? QString() : ": " + escaped(plugin.reason)));
    text += row(translated("Id"), escaped(plugin.id));
    text += row(translated("Licence"), escaped(plugin.license));
    text += row(translated("From"), escaped(plugin.origin));
    text += row(translated("Folder"), escaped(plugin.folder.string()));
    text += row(translated("Requires"), list(plugin.requires_));
    text += row(translated("Can use"), list(plugin.optional));
    text += row(translated("Conflicts"), list(plugin.conflicts));
    text += row(translated("Remarks"), list(plugin.warnings));
    text += row(translated("Offers"), contributionsOf(plugin));
    if (plugin.loadMs > 0) text += row(translated("Loaded in"), QStringLiteral("%1 ms").arg(plugin.loadMs, 0, 'f', 2));
    text += row(translated("Memory"), sizeText(plugin.mappedBytes));
    text += row(translated("Calls"), costsOf(plugin));
    return text + QStringLiteral("</table>");
}

}  // namespace jet::plugins
