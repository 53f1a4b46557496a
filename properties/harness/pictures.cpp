// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/harness/pictures.h"

namespace plumbline {

verdict::FramePictures draw(const PictureOrder& order, const oracle::RayDevice& device) {
  const std::unique_ptr<LodMethod> method = order.new_flyer();
  LodFrame frame;
  for (int f = 0; f <= order.frame; ++f) method->update((*order.cameras)[static_cast<std::size_t>(f)], frame);

  const Camera& camera = (*order.cameras)[static_cast<std::size_t>(order.frame)];
  const oracle::RaySurface surface(device, frame.mesh);
  const oracle::RaySurface& reference = *order.stage->surface;
  const oracle::PixelHits hits = surface.look(camera);
  const oracle::PixelHits reference_hits = reference.look(camera);
  oracle::ImageMaps maps;
  if (order.stage->subject == Subject::mesh) {
    oracle::ray_error(camera, reference_hits, hits, &maps.displacement_px);
  } else {
    oracle::image_error(camera, reference, reference_hits, surface, hits, order.threshold_px, &maps);
  }

  verdict::FramePictures out;
  out.run = order.run;
  out.frame = order.frame;
  out.threshold_px = order.threshold_px;
  out.shaded = oracle::shade(camera, surface, hits, true);
  out.reference = oracle::shade(camera, reference, reference_hits, false);
  out.displacement_px = std::move(maps.displacement_px);
  return out;
}

}  // namespace plumbline
