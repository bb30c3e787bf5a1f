// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkLogger.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkOutputWindow;

namespace talus
{

class VtkErrors;

/// Has VTK's errors kept, and neither printed nor logged, as long as it lives: what users read is our sentence.
class QuietVtk
{
public:
    QuietVtk();
    ~QuietVtk();
    QuietVtk(const QuietVtk&) = delete;
    QuietVtk& operator=(const QuietVtk&) = delete;

    /// The first error without the place in VTK's source that it begins with; empty where there was none.
    std::string sentence() const;

private:
    vtkSmartPointer<VtkErrors> errors_;
    vtkSmartPointer<vtkOutputWindow> window_; ///< where errors went before
    vtkLogger::Verbosity verbosity_;
};

} // namespace talus
