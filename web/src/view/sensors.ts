/** Sensors: what touches nobody is drawn as a pane that one sees through, with its edges. */
import { EdgesGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, type BufferGeometry } from 'three';
import { present, type BodyInfo, type Frame, type Roster } from '../model';
import { solidGeometry } from './bodies';
import { overlayHex } from './palette';

/** [°] between faces above which their edge is drawn */
const sharp = 25;

export class Sensors {
  readonly group = new Group();
  private readonly pane = new MeshBasicMaterial({ color: overlayHex.outline, transparent: true, opacity: 0.14, depthWrite: false });
  private readonly edge = new LineBasicMaterial({ color: overlayHex.outline });
  private drawn: { body: BodyInfo; holder: Group }[] = [];

  setRoster(roster: Roster): void {
    for (const { holder } of this.drawn) for (const child of holder.children) ((child as Mesh).geometry as BufferGeometry).dispose();
    this.group.clear();
    this.drawn = [...roster.bodies.values()].filter((body) => body.sensor && body.shape.type !== 'plane').map((body) => {
      const geometry = solidGeometry(body.shape, [32, 16]);
      const holder = new Group();
      holder.add(new Mesh(geometry, this.pane), new LineSegments(new EdgesGeometry(geometry, sharp), this.edge));
      this.group.add(holder);
      return { body, holder };
    });
  }

  update(frame: Frame): void {
    for (const { body: { slot }, holder } of this.drawn) {
      holder.visible = slot < frame.slots && (frame.flags[slot] & present) !== 0;
      if (!holder.visible) continue;
      holder.position.fromArray(frame.position, 3 * slot);
      holder.quaternion.fromArray(frame.orientation, 4 * slot);
    }
  }
}
