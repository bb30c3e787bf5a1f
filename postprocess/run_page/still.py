# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of the grains without a graphics card or a window: for paper, and for browsers without WebGL."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkJPEGWriter

WIDTH, HEIGHT, OVERSAMPLING = 960, 640, 2
TOWARDS_EYE = (0.30, -1.0, 0.24)  # as the viewer looks at first, viewer/stage.js
TANGENT = 0.23  # of half the angle of view
RAMP = ((0.0, (0.94, 0.81, 0.63)), (0.3, (0.97, 0.67, 0.36)), (0.65, (0.82, 0.28, 0.33)), (1.0, (0.35, 0.14, 0.48)))
CHUNK = 2_000_000  # pixels of grains at a time


def still(positions, radii, values, box):
    """A JPEG of spheres, coloured by values from 0 to 1, in a picture that holds the box."""
    eye, axes = camera(box)
    size = numpy.array([WIDTH, HEIGHT]) * OVERSAMPLING
    seen = (positions - eye) @ axes.T  # to the right, up, away
    scale = size[1] / 2 / TANGENT
    good = numpy.isfinite(seen).all(axis=1) & (seen[:, 2] > radii)
    seen, radii, values = seen[good], radii[good], values[good]
    depth, owner = nearest(seen, radii, scale, size)
    picture = shaded(depth, owner, seen, radii, values, scale, size)
    picture = picture.reshape(HEIGHT, OVERSAMPLING, WIDTH, OVERSAMPLING, 3).mean(axis=(1, 3))
    return jpeg((numpy.clip(picture, 0, 1) * 255).astype(numpy.uint8))


def camera(box):
    """Where the eye is, and unit vectors to the right, up in the picture and away from the eye."""
    low, high = (numpy.asarray(corner) for corner in box)
    away = -numpy.array(TOWARDS_EYE) / numpy.linalg.norm(TOWARDS_EYE)
    right = numpy.cross(away, (0.0, 0.0, 1.0))
    right /= numpy.linalg.norm(right)
    axes = numpy.array([right, numpy.cross(right, away), away])
    middle = (low + high) / 2
    corners = (numpy.array(numpy.meshgrid(*zip(low, high))).reshape(3, 8).T - middle) @ axes.T
    distance = 1.06 * (numpy.maximum(numpy.abs(corners[:, 0]) * HEIGHT / WIDTH, numpy.abs(corners[:, 1])) / TANGENT - corners[:, 2]).max()
    return middle - distance * away, axes


def nearest(seen, radii, scale, size):
    """For each pixel the depth of what is seen there, and of which grain: −1 none."""
    key = numpy.full(size[0] * size[1], numpy.iinfo(numpy.uint64).max, dtype=numpy.uint64)
    far = float(seen[:, 2].max(initial=1.0) + radii.max(initial=0.0)) * 1.001
    reach = numpy.ceil(radii / seen[:, 2] * scale).astype(int) + 1
    for pixels in numpy.unique(reach):
        offsets = numpy.stack(numpy.meshgrid(*2 * [numpy.arange(-pixels, pixels + 1)]), axis=-1).reshape(-1, 2)
        members = numpy.flatnonzero(reach == pixels)
        each = max(1, CHUNK // len(offsets))
        for first in range(0, len(members), each):
            grains = members[first:first + each]
            middle = numpy.stack([size[0] / 2 + seen[grains, 0] / seen[grains, 2] * scale,
                                  size[1] / 2 - seen[grains, 1] / seen[grains, 2] * scale], axis=1)
            at = numpy.rint(middle).astype(int)[:, None] + offsets
            out = (at + 0.0 - middle[:, None]) * (seen[grains, 2] / scale)[:, None, None]
            high2 = radii[grains, None] ** 2 - (out ** 2).sum(axis=-1)
            hit = (high2 > 0) & (at >= 0).all(axis=-1) & (at < size).all(axis=-1)
            depth = seen[grains, 2, None] - numpy.sqrt(numpy.maximum(high2, 0))
            entry = ((depth / far * 2**31).astype(numpy.uint64) << numpy.uint64(32)) | grains[:, None].astype(numpy.uint64)
            numpy.minimum.at(key, (at[..., 1] * size[0] + at[..., 0])[hit], entry[hit])
    empty = key == numpy.iinfo(numpy.uint64).max
    owner = numpy.where(empty, -1, (key & numpy.uint64(0xFFFFFFFF)).astype(numpy.int64))
    depth = numpy.where(empty, far, (key >> numpy.uint64(32)).astype(float) / 2**31 * far)
    return depth.reshape(size[::-1]), owner.reshape(size[::-1])


def shaded(depth, owner, seen, radii, values, scale, size):
    """The colours of all pixels: light from the left above, outlines where the depth jumps."""
    picture = numpy.ones((*owner.shape, 3))
    row, column = numpy.nonzero(owner >= 0)
    grain, z = owner[row, column], depth[row, column]
    point = numpy.stack([(column - size[0] / 2) * z / scale, (size[1] / 2 - row) * z / scale, z], axis=1)
    normal = (point - seen[grain]) / radii[grain, None]
    light = numpy.array([-0.45, 0.65, -0.61])
    bright = 0.55 + 0.5 * numpy.clip(normal @ light, 0, 1)
    places, knots = zip(*RAMP)
    colours = numpy.stack([numpy.interp(values[grain], places, channel) for channel in zip(*knots)], axis=1)
    logs = numpy.log(depth)
    jump = numpy.zeros_like(depth)
    for axis in (0, 1):
        for shift in (-2, 2):
            jump += numpy.clip(logs - numpy.roll(logs, shift, axis=axis), 0, 0.02)
    picture[row, column] = colours * (bright * numpy.exp(-25 * jump[row, column]))[:, None]
    return picture


def jpeg(picture):
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.ascontiguousarray(picture[::-1].reshape(-1, 3)), deep=True))
    writer = vtkJPEGWriter()
    writer.SetInputData(image)
    writer.SetQuality(82)
    writer.WriteToMemoryOn()
    writer.Write()
    return bytes(vtk_to_numpy(writer.GetResult()))
