#!/usr/bin/env python3
"""Writes the scenes of this folder (README.md lists them). Standard library only; deterministic.

usage: make_scenes.py [FOLDER]"""
import pathlib
import sys

from making import environment, extreme, fog, gallery, lights, models, streets, vases

HERE = pathlib.Path(__file__).resolve().parent

SCENES = {
    "white_plane": gallery.white_plane,
    "spheres": gallery.spheres,
    "lights": gallery.lights,
    "teapot": gallery.teapots,
    "textured": gallery.textured,
    "blend": gallery.blend,
    "many_lights": gallery.many_lights,
    "animated": gallery.animated,
    "vases": vases.vases,
    "teapot_normals": vases.teapot_normals,
    "models": models.models,
    "lights/soft_light": lights.soft_light,
    "lights/interior": lights.interior,
    "lights/rect": lights.rect_light,
    "lights/disk": lights.disk_light,
    "lights/sphere": lights.sphere_light,
    "lights/tube": lights.tube_light,
    "lights/screen": lights.screen,
    "lights/shadow_directional": lights.shadow_directional,
    "lights/shadow_point": lights.shadow_point,
    "lights/shadow_spot": lights.shadow_spot,
    "lights/shadow_fence": lights.shadow_fence,
    "lights/street": streets.street,
    "lights/market": streets.market,
    "fog/even": fog.even_fog,
    "fog/height": fog.height_fog,
    "fog/airlight": fog.airlight,
    "environment/balls": environment.balls,
    "environment/sky": environment.sky,
    "panes": fog.panes,
    "glass": fog.glass,
}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for part in ("extreme", "data", "lights", "fog", "environment"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    for part in ("data", "lights"):
        models.merl_table(folder / part / "metallic_paint.binary", (32, 24), models.metallic_paint)
    (folder / "environment" / "directions.png").write_bytes(environment.directions())
    (folder / "lights" / "window.png").write_bytes(lights.window_picture())
    for name, make in SCENES.items():
        make().write(folder / f"{name}.gltf")
    for name, scene in extreme.extreme():
        scene.write(folder / "extreme" / f"{name}.gltf")


if __name__ == "__main__":
    main()
