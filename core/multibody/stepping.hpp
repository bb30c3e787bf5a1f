// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus::multibody
{

/// Target and compliance of one row over one step: y = G v + Σ λ − q.
struct SteppedRow {
    double target;     ///< q [m/s]
    double compliance; ///< Σ [1/kg]
};

/// Υ = 1/(1 + 4τ/h), eq. (2), for a relaxation time τ of constraint violations; τ = 2h damps critically.
inline double upsilon(double tau, double h)
{
    return 1.0 / (1.0 + 4.0 * tau / h);
}

/// A holonomic row, eq. (2): q = −(4/h) Υ g + Υ G v⁽⁰⁾, Σ = 4Υ/(k h²). The note has Σ = 1/k.
/// @param gap violation g [m]; @param speed its rate G v⁽⁰⁾ [m/s]; @param stiffness k [N/m], infinite if rigid
inline SteppedRow holonomic_row(double gap, double speed, double stiffness, double tau, double h)
{
    const double u = upsilon(tau, h);
    return {-4.0 / h * u * gap + u * speed, 4.0 * u / (stiffness * h * h)};
}

/// A nonholonomic row, Υ = 0: G v = w up to a slip of 1/γ per force.
/// @param velocity w [m/s]; @param damping γ [N s/m], infinite if the velocity is to be met
inline SteppedRow nonholonomic_row(double velocity, double damping, double h)
{
    return {velocity, 1.0 / (damping * h)};
}

} // namespace talus::multibody
