/** Draws pictures of a recording for `cairn export --png` and `--mp4` and sends them back. */
import type { Clip } from './clip';
import type { Connection } from './connection';
import { defaultOptions } from './model';
import type { FilmOrder } from './protocol';
import { Stage } from './view/stage';

/** @param taken waits until the last picture was taken */
export async function makeFilm(
  root: HTMLElement, clip: Clip, order: FilmOrder, connection: Connection, taken: () => Promise<void>,
): Promise<void> {
  const holder = document.createElement('main');
  holder.style.cssText = `position:fixed;left:0;top:0;width:${order.width}px;height:${order.height}px`;
  root.append(holder);
  const stage = new Stage(holder, 'film');
  const panel = stage.panels[0];
  panel.setRoster(clip.roster);
  stage.setTheme(order.theme);
  panel.setFrame(clip.frameAt(0), defaultOptions);
  stage.fix(order.width, order.height);
  if (order.camera) stage.lookFrom(order.camera); else stage.frameAll(0.95);
  stage.draw();
  for (const time of order.times) {
    panel.setFrame(clip.frameAt(time), defaultOptions);
    stage.draw();
    const blob = await stage.toBlob(`image/${order.format}`, 0.93);
    const next = taken();
    connection.sendBytes(await blob.arrayBuffer());
    await next;
  }
}
