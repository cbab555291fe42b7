declare module "worker-source" {
  const source: string;
  export default source;
}
declare module "worker-threads-source" {
  const source: string;
  export default source;
}
declare module "element-style" {
  const style: string;
  export default style;
}
