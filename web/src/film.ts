/** Draws pictures of a recording for `cairn export --png` and `--mp4` and sends them back. */
import type { Clip } from './clip';
import type { Connection } from './connection';
import { defaultOptions, type ViewOptions } from './model';
import type { FilmOrder } from './protocol';
import { extentOf } from './view/panel';
import { Stage } from './view/stage';

/** @param taken waits until the last picture was taken */
export async function makeFilm(
  root: HTMLElement, clip: Clip, order: FilmOrder, connection: Connection, taken: () => Promise<void>,
): Promise<void> {
  const holder = document.createElement('main');
  holder.style.cssText = `position:fixed;left:0;top:0;width:${order.width}px;height:${order.height}px`;
  root.append(holder);
  const options: ViewOptions = { ...defaultOptions };
  for (const layer of ['points', 'normals', 'impulses', 'friction', 'joints', 'laws'] as const) options[layer] = order.layers.includes(layer);
  const stage = new Stage(holder, 'film');
  const panel = stage.panels[0];
  panel.setRoster(clip.roster);
  stage.setTheme(order.theme);
  // The picture shows where the bodies are in it, a film where they are in all of it.
  const middle = order.times[order.times.length >> 1] ?? 0;
  panel.setFrame(clip.frameAt(middle), options);
  for (const time of [order.times[0], order.times[order.times.length - 1]]) panel.extent.box.union(extentOf(clip.roster, clip.frameAt(time)).box);
  stage.fix(order.width, order.height);
  if (order.camera) stage.lookFrom(order.camera); else stage.frameAll(1.04);
  stage.draw();
  for (const time of order.times) {
    panel.setFrame(clip.frameAt(time), options);
    stage.draw();
    const blob = await stage.toBlob(`image/${order.format}`, 0.93);
    const next = taken();
    connection.sendBytes(await blob.arrayBuffer());
    await next;
  }
}
