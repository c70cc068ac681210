/** Pointer on the canvas: drags bodies, clicks select, everything else is left to the camera. */
import { Plane, Vector3 } from 'three';
import type { Hit } from '../view/pick';
import { pick } from '../view/pick';
import { fixed } from '../model';
import type { Stage } from '../view/stage';

export interface DragActions {
  /** @return false if this body cannot be dragged */
  grab(hit: Hit): boolean;
  drag(target: Vector3): void;
  release(): void;
  select(hit: Hit | null): void;
}

const clickDistance = 5;

export class Dragging {
  /** where the pointer was last [CSS pixels] */
  pointer: { x: number; y: number } | null = null;
  private held: { hit: Hit; plane: Plane; pointer: number; moved: boolean; grabbed: boolean } | null = null;
  private down: { x: number; y: number } | null = null;

  constructor(private readonly stage: Stage, private readonly actions: DragActions) {
    const canvas = stage.canvas;
    // In the capture phase, before the camera's own listeners.
    canvas.addEventListener('pointerdown', (event) => this.press(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.lift(event));
    canvas.addEventListener('pointercancel', () => this.drop());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
  }

  /** The body under a point of the window. */
  hitAt(x: number, y: number): Hit | null {
    const { ray, panel } = this.stage.rayAt(x, y);
    return panel.roster && panel.frame ? pick(ray, panel.roster, panel.frame) : null;
  }

  get dragging(): boolean { return this.held?.grabbed ?? false; }

  private press(event: PointerEvent): void {
    this.stage.canvas.focus({ preventScroll: true });
    this.pointer = { x: event.clientX, y: event.clientY };
    if (event.button !== 0 || !event.isPrimary) {
      this.drop();
      return;
    }
    this.down = { x: event.clientX, y: event.clientY };
    const hit = this.hitAt(event.clientX, event.clientY);
    if (!hit) return;
    const panel = this.stage.rayAt(event.clientX, event.clientY).panel;
    if ((panel.frame?.flags[hit.slot] ?? 0) & fixed) return;
    const towards = this.stage.camera.getWorldDirection(new Vector3());
    this.held = { hit, plane: new Plane().setFromNormalAndCoplanarPoint(towards, hit.point), pointer: event.pointerId, moved: false, grabbed: false };
    this.held.grabbed = this.actions.grab(hit);
    if (!this.held.grabbed) {
      this.held = null;
      return;
    }
    this.stage.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.stage.canvas.classList.add('grabbing');
  }

  private move(event: PointerEvent): void {
    this.pointer = { x: event.clientX, y: event.clientY };
    if (!this.held) {
      if (event.buttons === 0) this.stage.canvas.classList.toggle('over', this.hitAt(event.clientX, event.clientY) !== null);
      return;
    }
    if (event.pointerId !== this.held.pointer) return;
    if (this.down && Math.hypot(event.clientX - this.down.x, event.clientY - this.down.y) > clickDistance) this.held.moved = true;
    if (this.held.moved) this.pull(event.clientX, event.clientY);
  }

  private pull(x: number, y: number): void {
    if (!this.held) return;
    const target = this.stage.rayAt(x, y).ray.intersectPlane(this.held.plane, new Vector3());
    if (target) this.actions.drag(target);
  }

  private wheel(event: WheelEvent): void {
    if (!this.held || !this.pointer) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    const away = this.held.plane.normal;
    const distance = this.held.plane.distanceToPoint(this.stage.camera.position);
    this.held.plane.translate(away.clone().multiplyScalar(-Math.sign(event.deltaY) * 0.06 * Math.abs(distance)));
    this.held.moved = true;
    this.pull(this.pointer.x, this.pointer.y);
  }

  private lift(event: PointerEvent): void {
    const moved = this.held?.moved ?? (this.down !== null && Math.hypot(event.clientX - this.down.x, event.clientY - this.down.y) > clickDistance);
    if (event.button === 0 && this.down && !moved) this.actions.select(this.held?.hit ?? this.hitAt(event.clientX, event.clientY));
    this.drop();
  }

  private drop(): void {
    if (this.held) this.actions.release();
    this.held = null;
    this.down = null;
    this.stage.controls.enabled = true;
    this.stage.canvas.classList.remove('grabbing');
  }
}
