// Operations that make paths of paths: crossings, cutting, joining, simplifying. Pure functions of values; any thread.
// What needs a clipping library (union, difference, offset) is in the plugin org.jet.command.path-operations.
#pragma once

#include <jet/path.hpp>

#include <span>
#include <vector>

namespace jet {

/// A place where two curves meet: parameters on both, 0..1.
struct Crossing {
    double s = 0, t = 0;
    Vec2 point;
};

/// Where two cubics cross or touch, by ascending s; places nearer than `tolerance` (scene units) count once. Curves
/// that run along each other have no single crossings: what is found of them is at most 64 places. (Sederberg & Nishita
/// 1990 compare the ways; bounding boxes need no tangents, so cusps and lines are no special cases.)
JET_API std::vector<Crossing> crossings(const Cubic& a, const Cubic& b, double tolerance = 1e-7);

/// The pieces of `subject` between its crossings with `cutter`, in order along it, each a path with one open contour.
/// A contour that is not crossed stays whole. Intermediate counts are kept by each piece of a curve.
JET_API std::vector<Path> cutPath(const Path& subject, const Path& cutter);

/// All contours of the paths in one, the open ones connected at their nearest ends, nearest first, until one open
/// contour is left; that one is closed when it was the only one to begin with. Ends nearer than `tolerance` are merged,
/// others are joined by a straight side.
JET_API Path joinPaths(std::span<const Path> paths, double tolerance = 1e-6);

/// A path with fewer segments within `tolerance` (> 0, scene units) of the given one. Corners sharper than
/// `cornerAngle` (radians) and straight sides stay; each new segment gets the largest intermediate count of its
/// contour. (Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990.)
JET_API Path simplifyPath(const Path& path, double tolerance, double cornerAngle = 0.35);

/// Contours turned so that outer ones run clockwise on screen and holes the other way, by how many others they lie in:
/// both fill rules then show the same.
JET_API Path orientContours(const Path& path);

}  // namespace jet
