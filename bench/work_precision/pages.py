"""All pages of a folder of runs."""

import re

from work_precision import details_page, grid, overview_page, scene_page, spatial_page


def draw_all(scenes, runs):
    """Yields the name of a file, without ending, and its figure."""
    all_names = {run.solver for run in runs}
    accepted = [scene for scene in scenes if scene.accepted == "yes"]
    timed = [scene for scene in accepted if scene.kind != "spatial"]
    for scene in timed:
        own = [run for run in runs if (run.scene, run.kind) == (scene.scene, scene.kind)]
        yield file_name(scene, scenes), scene_page.draw(scene, own, all_names, grid.own_grid(scene, runs))
        yield file_name(scene, scenes) + "_details", details_page.draw(scene, own, all_names)
    if any(scene.kind != "spatial" for scene in scenes):
        yield "overview", overview_page.draw([scene for scene in scenes if scene.kind != "spatial"], runs, all_names)
    if any(scene.kind == "spatial" for scene in accepted):
        yield "spatial_error", spatial_page.draw([scene for scene in accepted if scene.kind == "spatial"], runs)


def file_name(scene, scenes):
    """Of a scene that is there both with and without its limit, the limited one says so."""
    kinds = {other.kind for other in scenes if other.scene == scene.scene and other.kind != "spatial"}
    name = re.sub(r"[^A-Za-z0-9_.-]", "_", scene.scene)
    return name + "_limited" if scene.kind == "limited" and len(kinds) > 1 else name
